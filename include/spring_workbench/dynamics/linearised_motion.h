#pragma once

#include <cmath>

#include "spring_workbench/dynamics/held_body.h"
#include "spring_workbench/math/implicit_matrix.h"

namespace spring_workbench::dynamics {

/// The equation of motion about one state: `M δq̈ = −K δq − D δq̇`. Springs and dampers enter exactly, so that no
/// stiffness costs digits; geometric stiffness, loads and gyroscopic terms by finite differences.
struct LinearisedMotion {
  rod::StrainMatrix M, K, D;
  /// `moment`: the same moment as `handle`, in every lane.
  LinearisedMotion(const HeldBody& body, const HandleState& handle, const HandleStates& moment,
                   const StrainState& state, const rod::StrainVector& q_ddot);
  /// Takes springs and dampers into account, but no load, gravity or gyroscopic term.
  LinearisedMotion(const HeldBody& body, const HandleState& handle, const rod::StrainVector& q);
  /// Size of a change of the rates, all coordinates together: the root of twice its kinetic energy.
  double size(const rod::StrainVector& q_dot) const { return std::sqrt(q_dot.dot(M * q_dot)); }
  /// Returns the matrix of an implicit step, in which the positions change by `d` [s] times the rates at its end.
  math::ImplicitMatrix implicit(double d) const { return {M, D, K, d}; }
};

}  // namespace spring_workbench::dynamics
