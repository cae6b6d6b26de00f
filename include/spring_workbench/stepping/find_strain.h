#pragma once

#include <functional>

#include "spring_workbench/dynamics/held_body.h"

namespace spring_workbench::stepping {

/// Result of find_strain().
struct FoundStrain {
  rod::StrainVector q;  ///< strain of the active coordinates
  bool found = false;   ///< otherwise the force is not zero there
};

/// Finds the strain of `held` at which `force`, a generalised force on its active coordinates, is zero, by Newton's
/// method from the strain `q` at time `t` [s], in which each step is halved until the force decreases. The size of a
/// force is the acceleration that it gives the body, all coordinates together; what counts as zero is a fraction of the
/// forces at no strain and at the start. If that is not reached, the result is the strain with the smallest force that
/// was tried. The result is always possible for the shape.
FoundStrain find_strain(const dynamics::HeldBody& held, double t,
                        const std::function<rod::StrainVector(const rod::StrainVector&)>& force, rod::StrainVector q);

}  // namespace spring_workbench::stepping
