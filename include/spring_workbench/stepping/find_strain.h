#pragma once

#include <functional>

#include "spring_workbench/dynamics/held_body.h"

namespace spring_workbench::stepping {

/// The strain of `held` at which `force`, a generalised force on its active coordinates, vanishes to `small` in norm:
/// by Newton's method from `q` at time `t` [s], each step halved until the force becomes smaller. Where it does not get
/// there, the strain with the smallest force that it met; always one that the shape admits.
rod::StrainVector find_strain(const dynamics::HeldBody& held, double t,
                              const std::function<rod::StrainVector(const rod::StrainVector&)>& force,
                              rod::StrainVector q, double small);

}  // namespace spring_workbench::stepping
