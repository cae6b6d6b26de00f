#include "spring_workbench/rod/difference_steps.h"

#include "constants.h"

namespace spring_workbench::rod {

StrainVector difference_steps(const StrainVector& least, const StrainVector& about) {
  return least.cwiseMax(resolved * about.cwiseAbs());
}

}  // namespace spring_workbench::rod
