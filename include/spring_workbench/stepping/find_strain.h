#pragma once

#include <functional>

#include "spring_workbench/dynamics/held_body.h"

namespace spring_workbench::stepping {

/// Returns the strain of `held` at which the norm of `force`, a generalised force on its active coordinates, is at most
/// `small`: by Newton's method from `q` at time `t` [s], in which each step is halved until the force decreases. If
/// there is no convergence, returns the strain with the smallest force found. The result is always possible for the
/// shape.
rod::StrainVector find_strain(const dynamics::HeldBody& held, double t,
                              const std::function<rod::StrainVector(const rod::StrainVector&)>& force,
                              rod::StrainVector q, double small);

}  // namespace spring_workbench::stepping
