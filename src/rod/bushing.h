#pragma once

#include "spring_workbench/rod/shape_model.h"

namespace spring_workbench::rod {

/// Six springs between handle and tip, without a curve (doc/model.md, `bushing`). q = (dx, dy, φx, φy, φz, dz) [m, rad]
/// with tip position (0, 0, L) + d and tip rotation exp(φ).
class Bushing final : public ShapeModel {
 public:
  /// `slope_stiffness`: see ForkSettings.
  Bushing(double length, std::optional<double> slope_stiffness)
      : ShapeModel(length), slope_stiffness_(slope_stiffness) {}

  int size() const override { return 6; }
  CoordinateRange bend() const override { return {0, 4}; }
  StrainVector units() const override;
  StrainVector stiffness(const PerDof& k) const override;
  StrainVector damping(const PerDof& c, const PerDof& k) const override;
  using ShapeModel::tip;
  void tip(const double* q, const double* q_dot, TipOf<double>& out) const override;
  void tip(const math::Pack* q, const math::Pack* q_dot, TipOf<math::Pack>& out) const override;
  bool strain_is_pose() const override { return true; }
  double extension(const StrainVector& q) const override { return q[5]; }
  double torsion_angle(const StrainVector& q) const override { return q[4]; }
  RigidTransform section(const StrainVector& q, double s) const override;
  bool rechart(StrainVector& q, StrainVector& q_dot) const override;
  double range_used(const StrainVector& q) const override;

 private:
  template <typename S>
  void tip_of(const S* q, const S* q_dot, TipOf<S>& out) const;
  void one_tip(const double* q, const double* q_dot, TipOf<double>& out) const;
  void tips(const math::Pack* q, const math::Pack* q_dot, TipOf<math::Pack>& out) const;

  StrainVector diagonal(const PerDof& per_dof, double slope) const;

  std::optional<double> slope_stiffness_;  ///< [N·m/rad]; by default L² / 3 of the bend stiffness
};

}  // namespace spring_workbench::rod
