#pragma once

#include "spring_workbench/rod/shape_model.h"

namespace spring_workbench {

/// The rod of doc/model.md with curvatures of `bend_terms` shifted Legendre polynomials each (1: constant, 2: linear),
/// constant twist rate and axial strain. q = (κx terms, κy terms, twist rate, axial strain) [1/m, 1/m, rad/m, –].
class StrainRod final : public ShapeModel {
 public:
  StrainRod(std::string name, double length, int bend_terms);

  std::string name() const override { return name_; }
  int size() const override { return 2 * bend_terms_ + 2; }
  CoordinateRange bend() const override { return {0, 2 * bend_terms_}; }
  StrainVector stiffness(const PerFamily& k) const override;
  void tip(const StrainVector& q, const StrainVector& q_dot, TipKinematics& out) const override;
  double extension(const StrainVector& q) const override;
  double twist(const StrainVector& q) const override;
  RigidTransform section(const StrainVector& q, double s) const override;
  bool admissible(const StrainVector& q) const override;

 private:
  /// Strain of the rod along its length: `value + slope (s − L/2)`.
  struct LinearStrain {
    Vector3d value = Vector3d::Zero();
    Vector3d slope = Vector3d::Zero();
  };
  LinearStrain curvature(const StrainVector& q) const;
  /// Upper bound of the angle through which the rod is turned [rad].
  double turned_angle(const LinearStrain& k) const;
  int pieces(double angle) const;

  std::string name_;
  int bend_terms_;
};

}  // namespace spring_workbench
