#pragma once

#include "spring_workbench/math/rigid_transform.h"

namespace spring_workbench::rod {

/// A rod of length 1 with three Legendre terms of curvature in each plane, clamped at the origin along z; nothing
/// condensed. Strain x = (κx₀, κx₁, κy₀, κy₁, τ, ε, κx₂, κy₂).
class ThreeTermRod {
 public:
  static constexpr int size = 8;
  static constexpr int stretch = 5;
  using Strain = Eigen::Matrix<double, size, 1>;
  using Jacobian = Eigen::Matrix<double, 6, size>;
  using Matrix = Eigen::Matrix<double, size, size>;
  using Vector6 = Eigen::Matrix<double, 6, 1>;
  using Matrix6 = Eigen::Matrix<double, 6, 6>;

  /// Pose of the section at `s`, 0 … 1.
  static RigidTransform section(const Strain& x, double s);
  /// Whether the rod is not turned inside out or wound up.
  static bool admissible(const Strain& x);

  /// The tip for the strain `x`, and what load_stiffness needs.
  explicit ThreeTermRod(const Strain& x);

  const Matrix3d& rotation() const { return R_; }
  const Vector3d& position() const { return p_; }
  /// [velocity; angular velocity] of the tip = jacobian · ẋ.
  const Jacobian& jacobian() const { return J_; }
  /// Derivative of jacobianᵀ · `wrench` by x, for a constant wrench [force; moment] at the tip.
  Matrix load_stiffness(const Vector6& wrench) const;

 private:
  static constexpr int nodes_per_segment = 8;
  static constexpr int most_substeps = 26;
  struct Node {
    Matrix3d R;
    Vector3d p;  ///< at unit stretch
  };

  double stretched_;
  int segments_;
  Node nodes_[nodes_per_segment * most_substeps];
  Matrix3d R_;
  Vector3d p_;
  Jacobian J_;
};

}  // namespace spring_workbench::rod
