#pragma once

#include <Eigen/LU>
#include <cmath>

#include "spring_workbench/dynamics/held_body.h"

namespace spring_workbench::dynamics {

/// The equation of motion about one state: `M δq̈ = −K δq − D δq̇`. Springs and dampers enter exactly, so that no
/// stiffness costs digits; geometric stiffness, loads and gyroscopic terms by finite differences.
struct LinearisedMotion {
  rod::StrainMatrix M, K, D;
  /// `moment`: the same moment as `handle`, in every lane.
  LinearisedMotion(const HeldBody& body, const HandleForcing& handle, const HandleForcings& moment,
                   const StrainState& state, const rod::StrainVector& q_ddot);
  /// Takes springs and dampers into account, but no load, gravity or gyroscopic term.
  LinearisedMotion(const HeldBody& body, const HandleForcing& handle, const rod::StrainVector& q);
  /// Size of a change of the rates, all coordinates together: the root of twice its kinetic energy.
  double size(const rod::StrainVector& q_dot) const { return std::sqrt(q_dot.dot(M * q_dot)); }
};

/// Solves `(M + d D + d² K) x = b`, scaled to unit diagonal, so that light and heavy coordinates can be combined.
class ImplicitMatrix {
 public:
  ImplicitMatrix(const LinearisedMotion& motion, double d);
  rod::StrainMatrix solve(const rod::StrainMatrix& b) const;
  template <int n>
  Eigen::Matrix<double, n, 1> solve(const Eigen::Matrix<double, n, 1>& b) const {
    const Eigen::Map<const Eigen::Matrix<double, n, n>> LU(lu_.matrixLU().data());
    Eigen::Matrix<double, n, 1> x;
    for (int i = 0; i < n; ++i) x[lu_.permutationP().indices()[i]] = scale_[i] * b[i];
    LU.template triangularView<Eigen::UnitLower>().solveInPlace(x);
    LU.template triangularView<Eigen::Upper>().solveInPlace(x);
    for (int i = 0; i < n; ++i) x[i] *= scale_[i];
    return x;
  }

 private:
  rod::StrainVector scale_;
  Eigen::PartialPivLU<rod::StrainMatrix> lu_;
};

}  // namespace spring_workbench::dynamics
