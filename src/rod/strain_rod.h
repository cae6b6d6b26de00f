#pragma once

#include "spring_workbench/rod/shape_model.h"

namespace spring_workbench::rod {

/// The rod of doc/model.md with curvatures of `bend_terms` shifted Legendre polynomials each (1: constant, 2: linear),
/// constant twist rate and axial strain. q = (κx terms, κy terms, twist rate, axial strain) [1/m, 1/m, rad/m, –].
class StrainRod final : public ShapeModel {
 public:
  StrainRod(double length, int bend_terms);

  int size() const override { return 2 * bend_terms_ + 2; }
  CoordinateRange bend() const override { return {0, 2 * bend_terms_}; }
  StrainVector units() const override;
  StrainVector stiffness(const PerDof& k) const override;
  using ShapeModel::tip;
  void tip(const double* q, const double* q_dot, TipOf<double>& out) const override;
  void tip(const math::Pack* q, const math::Pack* q_dot, TipOf<math::Pack>& out) const override;
  double extension(const StrainVector& q) const override;
  double torsion_angle(const StrainVector& q) const override;
  RigidTransform section(const StrainVector& q, double s) const override;
  double range_used(const StrainVector& q) const override;

 private:
  /// Strain of the rod along its length: `value + slope (s − L/2)`.
  template <typename S>
  struct LinearStrain {
    math::Vec3<S> value, slope;
  };
  template <typename S>
  LinearStrain<S> curvature(const S* q) const;
  /// Upper bound of the angle by which the rod turns along its length [rad].
  template <typename S>
  double turned_angle(const LinearStrain<S>& k) const;
  /// Factor by which the integrand of the quadrature grows with each derivative, over the whole rod. If the strain
  /// varies along the rod, the ten to twelve relevant derivatives are larger than the angle alone suggests, like those
  /// of exp(i b u²/2).
  template <typename S>
  double wave(const LinearStrain<S>& k, double angle) const;
  template <typename S>
  void tip_of(const S* q, const S* q_dot, TipOf<S>& out) const;
  void one_tip(const double* q, const double* q_dot, TipOf<double>& out) const;
  void tips(const math::Pack* q, const math::Pack* q_dot, TipOf<math::Pack>& out) const;
  /// Computes the tip with `count` segments of `nodes` quadrature nodes each; `angle`: see turned_angle().
  template <int nodes, typename S>
  void integrate(const S* q, const S* q_dot, int count, double angle, TipOf<S>& out) const;
  int segments(double angle) const;

  int bend_terms_;
};

}  // namespace spring_workbench::rod
