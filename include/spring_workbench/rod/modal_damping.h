#pragma once

#include "spring_workbench/rod/shape_model.h"

namespace spring_workbench::rod {

/// The damping matrix that gives every mode of a mass matrix `M` and a diagonal stiffness `K` the damping ratio
/// `ratio`: `D = 2 ζ M^½ (M^-½ K M^-½)^½ M^½`. Coordinates without stiffness have no damping.
StrainMatrix modal_damping(const StrainMatrix& M, const StrainVector& K, double ratio);

}  // namespace spring_workbench::rod
