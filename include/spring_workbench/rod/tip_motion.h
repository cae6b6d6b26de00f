#pragma once

#include "spring_workbench/rod/shape_model.h"

namespace spring_workbench::rod {

/// Adds what `size` strain rates (or accelerations) contribute to the angular and linear velocity (acceleration) of the
/// tip.
template <typename S>
SPRING_WORKBENCH_INLINE void add_tip_motion(const TipOf<S>& tip, int size, const S* rate, math::Vec3<S>& angular,
                                            math::Vec3<S>& linear) {
  for (int i = 0; i < size; ++i) {
    angular += rate[i] * tip.angular[i];
    linear += rate[i] * tip.linear[i];
  }
}

}  // namespace spring_workbench::rod
