#include "spring_workbench/friction/mean_velocity.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "constants.h"

namespace spring_workbench::friction {
namespace {

/// Bodies that press on each other. Each group goes by one of its members.
class Groups {
 public:
  explicit Groups(std::size_t bodies) : parent_(bodies) { std::iota(parent_.begin(), parent_.end(), 0); }

  std::size_t of(std::size_t body) {
    while (parent_[body] != body) body = parent_[body] = parent_[parent_[body]];
    return body;
  }
  void join(std::size_t a, std::size_t b) { parent_[of(a)] = of(b); }

 private:
  std::vector<std::size_t> parent_;
};

}  // namespace

std::vector<bool> move_with_mean_velocity(const std::vector<BodyVelocities>& bodies,
                                          const std::vector<BouncingContact*>& contacts, double h, double resting) {
  Groups groups(bodies.size());
  std::vector<bool> mean(bodies.size(), true);  // by group
  const auto of = [&](std::size_t body) { return groups.of(body); };
  const auto exclude = [&](const BouncingContact& c) { mean[of(c.a)] = mean[of(c.b)] = false; };
  for (const BouncingContact* c : contacts) {
    if (c->impulse[0] > 0.0 && bodies[c->a].free && bodies[c->b].free) groups.join(c->a, c->b);
  }
  const auto lead_of = [&](const BouncingContact& c) {
    Vector3d lead = Vector3d::Zero();
    for (const auto& [body, J] : {std::pair(c.a, &c.J_a), std::pair(c.b, &c.J_b)}) {
      if (bodies[body].free && mean[of(body)]) lead += 0.5 * h * *J * (bodies[body].start - bodies[body].end);
    }
    return lead;
  };
  // A load is constant if its contact neither closes, opens nor begins to stick in the step. Where several stick, they
  // may press against each other by as much as friction allows.
  const auto is_steady = [&](const BouncingContact& c) {
    const Vector3d lead = lead_of(c), end = c.J_a * bodies[c.a].end + c.J_b * bodies[c.b].end;
    const bool sticks =
        c.impulse.tail<2>().norm() < (1.0 - slip_share) * c.friction * c.impulse[0] || end.tail<2>().norm() <= resting;
    return std::abs(lead[0]) <= as_deep && (!sticks || lead.tail<2>().norm() <= as_deep);
  };
  for (const BouncingContact* c : contacts) {
    if (c->impulse[0] > 0.0 && (c->by_end_velocity || !is_steady(*c))) exclude(*c);
  }
  const auto goes_deeper = [&](const BouncingContact* c) {
    const double lead = lead_of(*c)[0];
    const double gap = c->gap + h * (c->J_a * bodies[c->a].end + c->J_b * bodies[c->b].end)[0];
    return lead < 0.0 && gap + lead < std::min(gap, 0.0) - as_deep;
  };
  for (auto c = contacts.begin(); c != contacts.end();) {
    c = std::find_if(contacts.begin(), contacts.end(), goes_deeper);
    if (c != contacts.end()) exclude(**c);
  }
  for (std::size_t i = 0; i < mean.size(); ++i) mean[i] = bodies[i].free && mean[of(i)];
  return mean;
}

}  // namespace spring_workbench::friction
