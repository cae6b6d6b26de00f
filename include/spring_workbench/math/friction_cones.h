#pragma once

#include <Eigen/Core>
#include <vector>

namespace spring_workbench::math {

/// Computes impulses `x` of contacts, three for each [normal, tangent, tangent], that fulfil Coulomb's law with the
/// rates `y = A x + b`: a contact that presses does not move along its normal, one that slides opposes its slip with
/// `friction` times the normal impulse, and no contact closes. `A` is symmetric and positive semidefinite, 3 n × 3 n.
///
/// A primal-dual interior point method on the friction cones (Nesterov and Todd's scaling, Mehrotra's corrector), with
/// De Saxcé's shift of the normal rate by the slip. It solves some 20 systems of equations, whatever the ratio of the
/// masses, where Gauss–Seidel needs thousands of iterations [NT98, DF98 in doc/model.md]. Returns false, and leaves `x`
/// unchanged, if it finds no such impulses.
bool solve_in_cones(const Eigen::MatrixXd& A, const Eigen::VectorXd& b, const std::vector<double>& friction,
                    Eigen::VectorXd& x);

}  // namespace spring_workbench::math
