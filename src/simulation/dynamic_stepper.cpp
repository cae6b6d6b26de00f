#include "dynamic_stepper.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "spring_workbench/math/so3.h"
#include "spring_workbench/scene/geometry.h"

namespace spring_workbench {
namespace {

constexpr double longest_piece = 2e-3;     ///< [s]
constexpr double shortest_step = 1e-9;     ///< [s]; of a step shorter than this contact takes no notice
constexpr double longest_travel = 5e-4;    ///< [m] of any point of a held body in a piece
constexpr int most_pieces = 2000;
/// Contact keeps clear the way over a piece for the most part, and for this part the way that the velocity at its end would
/// make. Of the way alone, the velocity of a soft fork would change its sign with every piece, for ever; of the velocity
/// alone, a stiff fork would not answer. Both errors shrink by a half in a piece with this share.
constexpr double velocity_share = 0.1;
constexpr double margin_near = 2e-3;       ///< [m]
constexpr double same_point = 2e-3;        ///< [m]

}  // namespace

DynamicStepper::DynamicStepper(const Scene& scene) : scene_(scene), world_(make_rigid_world(scene)) {
  for (const Body& body : scene.bodies) radius_.push_back(body.collision.empty() ? 0.0 : bounding_radius(body));
}

DynamicStepper::Way DynamicStepper::way(SteppedBody& body, double h) const {
  Way w;
  w.X0 = body.object().X;
  body.remember();
  w.possible = body.advance(h, Wrench());
  const MotionState end = body.object();
  w.X1 = w.possible ? end.X : w.X0;
  w.V1 = w.possible ? end.velocity : Twist();
  body.go_back();
  return w;
}

DynamicStepper::Outcome DynamicStepper::step(const std::vector<SteppedBody*>& held, double h) {
  contacts_.clear();
  held_.clear();
  for (const SteppedBody* body : held) held_.push_back(body->index());
  Outcome outcome;
  bool near = others_awake();
  double travel = 0.0;
  for (SteppedBody* body : held) {
    const Way w = way(*body, h);
    near = near || world_->may_touch(body->index(), w.X0, w.X1, margin_near);
    const double turned = log_so3(w.X0.linear().transpose() * w.X1.linear()).norm();
    travel = std::max(travel, (w.X1.translation() - w.X0.translation()).norm() + radius_[body->index()] * turned);
  }
  if (!near || h < shortest_step) {
    outcome.pieces = 1;
    for (SteppedBody* body : held) {
      body->remember();
      if (!body->advance(h, Wrench())) {
        body->go_back();
        body->stay(h);
        outcome.held_back = true;
      }
      const MotionState s = body->object();
      world_->place(body->index(), s.X, s.velocity, false);
    }
    return outcome;
  }
  const double wanted = std::max(h / longest_piece, travel / longest_travel);
  outcome.pieces = std::clamp(static_cast<int>(std::ceil(wanted - 1e-9)), 1, most_pieces);
  for (int i = 0; i < outcome.pieces; ++i) piece(held, h / outcome.pieces, outcome);
  return outcome;
}

void DynamicStepper::piece(const std::vector<SteppedBody*>& held, double h, Outcome& outcome) {
  std::vector<DrivenBody> driven;
  for (SteppedBody* body : held) {
    const Way w = way(*body, h);
    DrivenBody d;
    d.body = body->index();
    d.X_WO = w.X0;
    const Vector3d moved = w.X1.translation() - w.X0.translation();
    const Vector3d turned = w.X0.linear() * log_so3(w.X0.linear().transpose() * w.X1.linear());
    d.displacement_W.linear = (1.0 - velocity_share) * moved + velocity_share * h * w.V1.linear;
    d.displacement_W.angular = (1.0 - velocity_share) * turned + velocity_share * h * w.V1.angular;
    const SteppedBody::Answer answer = body->answer(h);
    d.compliance = (1.0 - velocity_share) * answer.displacement + velocity_share * h * answer.velocity;
    driven.push_back(d);
  }
  world_->step(h, driven);
  for (std::size_t i = 0; i < held.size(); ++i) {
    if (!held[i]->advance(h, driven[i].contact_W)) {
      held[i]->stay(h);
      outcome.held_back = true;
    }
    const MotionState s = held[i]->object();
    world_->place(held[i]->index(), s.X, s.velocity, true);
  }
  add_contacts();
}

void DynamicStepper::set_free(std::size_t body, const RigidTransform& X_WO, const Twist& V_WO_W) {
  world_->place(body, X_WO, V_WO_W, true);
  held_.erase(std::remove(held_.begin(), held_.end(), body), held_.end());
}

bool DynamicStepper::others_awake() const {
  const std::vector<std::size_t>& near = world_->bodies_near();
  return std::any_of(near.begin(), near.end(), [&](std::size_t body) {
    return world_->awake(body) && std::find(held_.begin(), held_.end(), body) == held_.end();
  });
}

bool DynamicStepper::comes_first(std::size_t body, std::size_t other) const {
  const auto rank = [&](std::size_t b) {
    if (b == RigidWorld::bench || !scene_.bodies[b].movable) return 2;
    return std::find(held_.begin(), held_.end(), b) != held_.end() ? 0 : 1;
  };
  return rank(body) <= rank(other);
}

void DynamicStepper::add_contacts() {
  for (WorldContact& known : contacts_) known.depth = 0.0;
  for (WorldContact c : world_->contacts()) {
    if (!comes_first(c.body, c.other)) {
      std::swap(c.body, c.other);
      c.n_W = -c.n_W;
      c.impulse_W = -c.impulse_W;
    }
    const auto same = std::find_if(contacts_.begin(), contacts_.end(), [&](const WorldContact& known) {
      return known.body == c.body && known.other == c.other && known.n_W.dot(c.n_W) > 0.99 &&
             (known.p_W - c.p_W).norm() < same_point;
    });
    if (same == contacts_.end()) {
      contacts_.push_back(c);
      continue;
    }
    const Vector3d sum = same->impulse_W + c.impulse_W;
    *same = c;
    same->impulse_W = sum;
  }
}

}  // namespace spring_workbench
