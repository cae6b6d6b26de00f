#include "spring_workbench/dynamics/find_strain.h"

#include <Eigen/LU>

namespace spring_workbench {
namespace {

constexpr int most_iterations = 30, most_halvings = 20;
constexpr double difference = 1e-6;  ///< of the strain, for the slope

StrainMatrix slope(const std::function<StrainVector(const StrainVector&)>& force, const StrainVector& q) {
  StrainMatrix slope(q.size(), q.size());
  for (Eigen::Index i = 0; i < q.size(); ++i) {
    StrainVector ahead = q, behind = q;
    ahead[i] += difference;
    behind[i] -= difference;
    slope.col(i) = (force(ahead) - force(behind)) / (2.0 * difference);
  }
  return slope;
}

}  // namespace

StrainVector find_strain(const HeldBody& held, double t, const std::function<StrainVector(const StrainVector&)>& force,
                         StrainVector q, double small) {
  const auto admissible = [&](const StrainVector& tried) {
    return held.shape().admissible(held.full_state(t, {tried, StrainVector::Zero(tried.size())}).q);
  };
  StrainVector f = force(q);
  for (int iteration = 0; iteration < most_iterations && f.norm() > small; ++iteration) {
    StrainVector change = -slope(force, q).partialPivLu().solve(f);
    if (!change.allFinite()) break;
    bool nearer = false;
    for (int halving = 0; halving < most_halvings && !nearer; ++halving, change *= 0.5) {
      const StrainVector tried = q + change;
      if (!admissible(tried)) continue;
      const StrainVector f_tried = force(tried);
      if (!f_tried.allFinite() || f_tried.norm() >= f.norm()) continue;
      q = tried;
      f = f_tried;
      nearer = true;
    }
    if (!nearer) break;
  }
  return q;
}

}  // namespace spring_workbench
