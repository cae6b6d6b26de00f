#pragma once

#include "spring_workbench/rod/shape_model.h"
#include "three_term_rod.h"

namespace spring_workbench::rod {

/// The rod with three Legendre terms of curvature in each plane (doc/model.md, `quadratic`). Coordinates are the six of
/// `linear`; the third terms r are those of least elastic energy among all strains with the same tip pose:
/// K₂ r = J₂ᵀ λ with the wrench λ that holds the six in equilibrium, J₆ᵀ λ = K₆ q. Where a family is off, its strain is
/// zero there as everywhere. Without stiffness against bending r = 0.
class QuadraticRod final : public ShapeModel {
 public:
  /// `stiffness` [N/m, N/m, N·m/rad] ≥ 0.
  QuadraticRod(double length, const PerDof& stiffness);

  int size() const override { return 6; }
  CoordinateRange bend() const override { return {0, 4}; }
  StrainVector stiffness(const PerDof& k) const override;
  std::shared_ptr<const ShapeModel> for_stiffness(const PerDof& k) const override;
  double condensed_energy(const StrainVector& q) const override;
  using ShapeModel::tip;
  void tip(const double* q, const double* q_dot, TipOf<double>& out) const override;
  void tip(const math::Pack* q, const math::Pack* q_dot, TipOf<math::Pack>& out) const override;
  double extension(const StrainVector& q) const override { return q[5] * length(); }
  double twist(const StrainVector& q) const override { return q[4] * length(); }
  RigidTransform section(const StrainVector& q, double s) const override;
  /// Also false where no condensed coordinates in equilibrium are found: the rod would buckle at a held tip.
  bool admissible(const StrainVector& q) const override;

 private:
  using Strain = ThreeTermRod::Strain;
  struct Condensed {
    Strain x;                           ///< all strains, of a rod of length 1
    Eigen::Matrix<double, 2, 6> slope;  ///< dr/dq
    Eigen::Matrix2d inverse;            ///< of the residual's derivative by r
    bool found = true;
  };
  Condensed condense(const StrainVector& q) const;
  struct Balance;

  Strain K_;  ///< stiffness [J] of a rod of length 1, κ and τ times the length
};

}  // namespace spring_workbench::rod
