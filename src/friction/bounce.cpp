#include "spring_workbench/friction/bounce.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "constants.h"

namespace spring_workbench::friction {
namespace {

/// What is given back, and what it changes.
class GivenBack {
 public:
  GivenBack(const std::vector<Eigen::MatrixXd>& responses, const std::vector<BouncingContact*>& contacts)
      : change(responses.size(), Vector6d::Zero()), responses_(responses), contacts_(contacts) {
    for (const BouncingContact* contact : contacts) {
      const BouncingContact& c = *contact;
      double yields = 0.0;
      each(c, [&](const auto& J, std::size_t body) {
        yields += (J.template bottomRows<2>() * responses[body] * J.template bottomRows<2>().transpose()).trace();
      });
      yields_.push_back(yields);
      loads.push_back(Vector3d::Zero());
      add(loads.size() - 1, c.restitution * c.impulse[0] * Vector3d::UnitX());
    }
  }

  /// Lets friction take what it can of a slip, which is `slip` without what is given back.
  void slide(std::size_t i, const Vector3d& slip) {
    if (!(loads[i][0] > 0.0 && yields_[i] > 0.0)) return;
    const Eigen::Vector2d now = (slip + contacts_[i]->by(change)).tail<2>();
    Eigen::Vector2d across = loads[i].tail<2>() - now / yields_[i];
    const double max_across = contacts_[i]->friction * loads[i][0];
    across *= std::min(1.0, max_across / std::max(across.norm(), std::numeric_limits<double>::min()));
    add(i, Vector3d(0.0, across[0] - loads[i][1], across[1] - loads[i][2]));
  }

  std::vector<Vector3d> loads;   ///< [N·s]
  std::vector<Vector6d> change;  ///< of the velocities

 private:
  template <typename Function>
  void each(const BouncingContact& c, const Function& function) const {
    if (responses_[c.a].size() > 0) function(c.J_a, c.a);
    if (responses_[c.b].size() > 0) function(c.J_b, c.b);
  }
  void add(std::size_t i, const Vector3d& load) {
    loads[i] += load;
    each(*contacts_[i],
         [&](const auto& J, std::size_t body) { change[body] += responses_[body] * (J.transpose() * load); });
  }

  const std::vector<Eigen::MatrixXd>& responses_;
  const std::vector<BouncingContact*>& contacts_;
  std::vector<double> yields_;  ///< across
};

}  // namespace

void apply_restitution(const std::vector<Eigen::MatrixXd>& responses, const std::vector<BouncingContact*>& contacts,
                       std::vector<Vector6d>& change) {
  GivenBack back(responses, contacts);
  for (int iteration = 0; iteration < bounce_iterations; ++iteration) {
    for (std::size_t i = 0; i < contacts.size(); ++i) back.slide(i, contacts[i]->motion + contacts[i]->by(change));
  }
  double lost = 0.0, slope = 0.0, curvature = 0.0;  // `lost` is a change, not above 0
  for (std::size_t i = 0; i < contacts.size(); ++i) {
    const Vector3d stopped = contacts[i]->motion + contacts[i]->by(change);
    lost += contacts[i]->impulse.dot(stopped - 0.5 * contacts[i]->by(change));
    slope += back.loads[i].dot(stopped);
    curvature += back.loads[i].dot(contacts[i]->by(back.change));
  }
  const double root = std::sqrt(std::max(0.0, slope * slope - 2.0 * curvature * lost));
  const double share = curvature > 0.0 ? std::clamp((root - slope) / curvature, 0.0, 1.0) : 1.0;
  for (std::size_t i = 0; i < contacts.size(); ++i) contacts[i]->impulse += share * back.loads[i];
  for (std::size_t i = 0; i < change.size(); ++i) change[i] += share * back.change[i];
}

}  // namespace spring_workbench::friction
