#include "spring_workbench/stepping/find_strain.h"

#include <Eigen/Cholesky>
#include <Eigen/LU>

#include "constants.h"
#include "spring_workbench/rod/difference_steps.h"

namespace spring_workbench::stepping {
namespace {

rod::StrainMatrix slope(const dynamics::HeldBody& held,
                        const std::function<rod::StrainVector(const rod::StrainVector&)>& force,
                        const rod::StrainVector& q) {
  const rod::StrainVector dq = rod::difference_steps(strain_difference * held.units(), q);
  rod::StrainMatrix slope(q.size(), q.size());
  for (Eigen::Index i = 0; i < q.size(); ++i) {
    rod::StrainVector ahead = q, behind = q;
    ahead[i] += dq[i];
    behind[i] -= dq[i];
    slope.col(i) = (force(ahead) - force(behind)) / (ahead[i] - behind[i]);
  }
  return slope;
}

}  // namespace

FoundStrain find_strain(const dynamics::HeldBody& held, double t,
                        const std::function<rod::StrainVector(const rod::StrainVector&)>& force, rod::StrainVector q) {
  const auto admissible = [&](const rod::StrainVector& tried) {
    return held.shape().admissible(held.full_state(t, {tried, rod::StrainVector::Zero(tried.size())}).q);
  };
  const Eigen::LLT<rod::StrainMatrix> mass(held.mass_matrix(t, q));
  const auto size = [&](const rod::StrainVector& f) { return rod::StrainVector(mass.matrixL().solve(f)).norm(); };
  rod::StrainVector f = force(q);
  double left = size(f);
  const double all = left + size(force(rod::StrainVector::Zero(q.size())));
  for (int iteration = 0; iteration < most_strain_iterations && left > strain_accuracy * all; ++iteration) {
    rod::StrainVector change = -slope(held, force, q).partialPivLu().solve(f);
    if (!change.allFinite()) break;
    bool nearer = false;
    for (int halving = 0; halving < most_strain_halvings && !nearer; ++halving, change *= 0.5) {
      const rod::StrainVector tried = q + change;
      if (!admissible(tried)) continue;
      const rod::StrainVector f_tried = force(tried);
      const double left_then = size(f_tried);
      if (!(left_then < left)) continue;
      q = tried;
      f = f_tried;
      left = left_then;
      nearer = true;
    }
    if (!nearer) break;
  }
  return {q, left <= max_strain_error * all};
}

}  // namespace spring_workbench::stepping
