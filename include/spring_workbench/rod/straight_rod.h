#pragma once

#include "spring_workbench/math/so3.h"
#include "spring_workbench/rod/shape_model.h"

namespace spring_workbench::rod {

/// A shape model's rod while it cannot bend. It then turns and stretches along its own axis only, which needs no
/// quadrature however often it is wound up.
class StraightRod {
 public:
  explicit StraightRod(const ShapeModel& shape)
      : torsion_(shape.torsion().begin), stretch_(shape.stretch().begin), length_(shape.length()) {
    twist_ = shape.twist(StrainVector::Unit(shape.size(), torsion_));
    extension_ = shape.extension(StrainVector::Unit(shape.size(), stretch_));
  }

  /// ShapeModel::tip for the strain `q` without bend. The columns of the bend coordinates are set to zero.
  template <typename S>
  SPRING_WORKBENCH_INLINE void tip(const S* q, TipOf<S>& out) const {
    const math::Three<S> zero = math::none<S>();
    const S angle = twist_ * q[torsion_];
    out.R_HE = math::exp_so3<S>({S{}, S{}, angle}, math::so3_coefficients<S>(angle * angle));
    out.p_HE = {S{}, S{}, length_ + extension_ * q[stretch_]};
    for (int i = 0; i <= stretch_; ++i) out.angular[i] = out.linear[i] = zero;
    out.angular[torsion_].z = S{} + twist_;
    out.linear[stretch_].z = S{} + extension_;
    out.angular_bias = out.linear_bias = zero;
  }

 private:
  int torsion_, stretch_;
  double length_;
  double twist_, extension_;  ///< by unit of their coordinates
};

}  // namespace spring_workbench::rod
