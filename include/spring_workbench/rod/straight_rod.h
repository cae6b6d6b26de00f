#pragma once

#include "spring_workbench/math/so3.h"
#include "spring_workbench/rod/shape_model.h"

namespace spring_workbench::rod {

inline StraightRod::StraightRod(const ShapeModel& shape)
    : torsion_(shape.torsion().begin),
      stretch_(shape.stretch().begin),
      length_(shape.length()),
      twist_(shape.torsion_angle(StrainVector::Unit(shape.size(), torsion_))),
      extension_(shape.extension(StrainVector::Unit(shape.size(), stretch_))) {}

template <typename S>
SPRING_WORKBENCH_INLINE void StraightRod::tip(const S* q, TipOf<S>& out) const {
  const math::Vec3<S> zero = math::zero<S>();
  const S angle = twist_ * q[torsion_];
  out.R_HE = math::exp_so3<S>({S{}, S{}, angle}, math::so3_coefficients<S>(angle * angle));
  out.p_HE = {S{}, S{}, length_ + extension_ * q[stretch_]};
  for (int i = 0; i <= stretch_; ++i) out.angular[i] = out.linear[i] = zero;
  out.angular[torsion_].z = S{} + twist_;
  out.linear[stretch_].z = S{} + extension_;
  out.angular_bias = out.linear_bias = zero;
}

}  // namespace spring_workbench::rod
