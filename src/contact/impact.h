#pragma once

#include <vector>

#include "spring_workbench/contact/contact_solver.h"

namespace spring_workbench::contact {

/// Impulse on a body with the velocity `v` [linear; angular] at its centre. It ends the approach of the contacts, whose
/// levers and gaps are given, and gives back of each one's normal impulse its `restitution` (0 … 1), by Poisson's law.
/// An open contact without restitution may approach so fast that it closes within `h` [s]. Out: `load_W`, of each.
Wrench impact(friction::ContactProblem& problem, const Matrix6d& mobility, const Vector6d& v,
              std::vector<ContactRow>& contacts, const std::vector<double>& restitution, double h);

}  // namespace spring_workbench::contact
