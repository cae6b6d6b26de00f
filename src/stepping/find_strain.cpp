#include "spring_workbench/stepping/find_strain.h"

#include <Eigen/LU>

#include "constants.h"

namespace spring_workbench::stepping {
namespace {

rod::StrainMatrix slope(const std::function<rod::StrainVector(const rod::StrainVector&)>& force,
                        const rod::StrainVector& q) {
  rod::StrainMatrix slope(q.size(), q.size());
  for (Eigen::Index i = 0; i < q.size(); ++i) {
    rod::StrainVector ahead = q, behind = q;
    ahead[i] += strain_difference;
    behind[i] -= strain_difference;
    slope.col(i) = (force(ahead) - force(behind)) / (2.0 * strain_difference);
  }
  return slope;
}

}  // namespace

rod::StrainVector find_strain(const dynamics::HeldBody& held, double t,
                              const std::function<rod::StrainVector(const rod::StrainVector&)>& force,
                              rod::StrainVector q, double small) {
  const auto admissible = [&](const rod::StrainVector& tried) {
    return held.shape().admissible(held.full_state(t, {tried, rod::StrainVector::Zero(tried.size())}).q);
  };
  rod::StrainVector f = force(q);
  for (int iteration = 0; iteration < most_strain_iterations && f.norm() > small; ++iteration) {
    rod::StrainVector change = -slope(force, q).partialPivLu().solve(f);
    if (!change.allFinite()) break;
    bool nearer = false;
    for (int halving = 0; halving < most_strain_halvings && !nearer; ++halving, change *= 0.5) {
      const rod::StrainVector tried = q + change;
      if (!admissible(tried)) continue;
      const rod::StrainVector f_tried = force(tried);
      if (!f_tried.allFinite() || f_tried.norm() >= f.norm()) continue;
      q = tried;
      f = f_tried;
      nearer = true;
    }
    if (!nearer) break;
  }
  return q;
}

}  // namespace spring_workbench::stepping
