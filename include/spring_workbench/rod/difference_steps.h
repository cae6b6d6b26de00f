#pragma once

#include "spring_workbench/rod/shape_model.h"

namespace spring_workbench::rod {

/// Finite-difference steps about the strains or rates `about`: `least`, but larger for components so large that `least`
/// would vanish in rounding.
StrainVector difference_steps(const StrainVector& least, const StrainVector& about);

}  // namespace spring_workbench::rod
