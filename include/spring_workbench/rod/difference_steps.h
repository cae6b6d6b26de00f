#pragma once

#include "spring_workbench/rod/shape_model.h"

namespace spring_workbench::rod {

/// Steps of finite differences about strains or rates: these ones, or more where they would be lost in the rounding of
/// one that is far off.
StrainVector difference_steps(const StrainVector& least, const StrainVector& about);

}  // namespace spring_workbench::rod
