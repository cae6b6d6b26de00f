#include "strain_limit.h"

#include <Eigen/Cholesky>

namespace spring_workbench::dynamics {
namespace {

constexpr int halvings = 40;  ///< of the way to the limit

}  // namespace

bool stop_at_limit(const HeldBody& body, double t, const StrainState& begin, StrainState& end) {
  if (!end.q.allFinite() || !end.q_dot.allFinite()) return false;
  const auto possible = [&](Eigen::Index coordinate, double strain) {
    StrainState tried = end;
    tried.q[coordinate] = strain;
    return body.shape().admissible(body.full_state(t, tried).q);
  };
  // Stretch is the last coordinate, torsion the one before.
  Eigen::Index i = end.q.size() - 1;
  while (i >= 0 && !possible(i, begin.q[i])) --i;
  if (i < 0) return false;
  const double way = end.q[i] - begin.q[i];
  double shortest = 0.0, longest = 1.0;
  for (int k = 0; k < halvings; ++k) {
    const double part = 0.5 * (shortest + longest);
    (possible(i, begin.q[i] + part * way) ? shortest : longest) = part;
  }
  end.q[i] = begin.q[i] + shortest * way;
  if (end.q_dot[i] * way > 0.0) {
    const rod::StrainVector response = body.mass_matrix(t, end.q).llt().solve(rod::StrainVector::Unit(end.q.size(), i));
    end.q_dot -= end.q_dot[i] / response[i] * response;
    end.q_dot[i] = 0.0;
  }
  return end.q_dot.allFinite();
}

}  // namespace spring_workbench::dynamics
