#include "workbench.h"

#include <algorithm>

#include "spring_workbench/scene/geometry.h"

namespace spring_workbench {
namespace {

constexpr double asleep_speed = 2e-3;  ///< [m/s]; a body in contact that stays slower …
constexpr double asleep_after = 0.2;   ///< [s] … this long goes to sleep
constexpr double support_gap = 1e-4;   ///< [m]; what is nearer below carries
constexpr double world_limit = 100.0;  ///< [m] from the origin; a body that flies further stops there

}  // namespace

Workbench::Workbench(const Scene& scene, int bisection_levels) : scene_(scene), contacts_(scene) {
  for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
    if (scene.bodies[i].movable) movable_.push_back(i);
  }
  if (scene.contact != ContactMode::none) {
    collision_ = std::make_unique<CollisionWorld>(scene);
    contact_stepper_ = std::make_unique<ContactStepper>(scene, *collision_, bisection_levels);
  }
  reset();
}

void Workbench::reset() {
  contacts_.reset(movable_.size());
  states_.assign(movable_.size(), BodyState());
  rows_.assign(movable_.size(), {});
  slow_since_.assign(movable_.size(), 0.0);
  free_bodies_.clear();
  free_bodies_.resize(movable_.size());
  for (std::size_t i = 0; i < movable_.size(); ++i) {
    states_[i].name = body(i).name;
    states_[i].X_WO = body(i).X_WO;
    if (collision_) collision_->set_pose(movable_[i], body(i).X_WO);
  }
}

void Workbench::clear_highlights() {
  for (BodyState& o : states_) o.highlighted = false;
}

std::optional<std::size_t> Workbench::find(const std::string& name) const {
  for (std::size_t i = 0; i < states_.size(); ++i) {
    if (states_[i].name == name) return i;
  }
  return std::nullopt;
}

bool Workbench::any_free() const {
  return std::any_of(free_bodies_.begin(), free_bodies_.end(), [](const auto& b) { return b != nullptr; });
}

void Workbench::take_state(std::size_t object, const MotionState& s) {
  states_[object].X_WO = s.X;
  states_[object].V_WO_W = s.velocity;
  if (collision_) collision_->set_pose(movable_[object], s.X);
}

void Workbench::hold(std::size_t object, double now) {
  free_bodies_[object].reset();
  rows_[object].clear();
  states_[object].held = true;
  states_[object].highlighted = false;
  states_[object].asleep = false;
  wake_what_lies_on(object, now);
}

void Workbench::let_go(std::size_t object, bool thrown, double now) {
  BodyState& o = states_[object];
  o.held = false;
  if (!thrown || massless(object)) o.V_WO_W = Twist();
  if (massless(object)) {
    o.asleep = true;
  } else {
    set_free(object, o.V_WO_W, now);
  }
}

void Workbench::set_free(std::size_t object, const Twist& V_WO_W, double now) {
  free_bodies_[object] = std::make_unique<FreeBody>(movable_[object], body(object), scene_.gravity,
                                                    states_[object].X_WO, V_WO_W);
  slow_since_[object] = now;
}

/// Sleepers that rest on `object`, and on one another, are free to fall.
void Workbench::wake_what_lies_on(std::size_t object, double now) {
  if (!collision_) return;
  std::vector<ContactPoint> found;
  for (std::size_t i = 0; i < states_.size(); ++i) {
    if (i == object || !states_[i].asleep || states_[i].held || massless(i)) continue;
    RigidTransform lowered = states_[i].X_WO;
    lowered.translation().z() -= support_gap;
    found.clear();
    collision_->find_contacts(movable_[i], lowered, 0.0, found);
    const bool rests_on_it = std::any_of(found.begin(), found.end(), [&](const ContactPoint& c) {
      return c.other == movable_[object] && c.n_W.z() > 0.1;
    });
    if (!rests_on_it) continue;
    set_free(i, Twist(), now);
    states_[i].asleep = false;
    wake_what_lies_on(i, now);
  }
}

void Workbench::carry(SteppedBody& stepped, std::size_t object, double h, AdvanceReport& report) {
  ++report.steps;
  ContactOutcome outcome;
  if (contact_stepper_) {
    contact_stepper_->step(stepped, h, rows_[object], outcome);
  } else {
    stepped.remember();
    if (!stepped.advance(h, Wrench())) {
      stepped.go_back();
      stepped.stay(h);
      outcome.held_back = true;
    }
  }
  take_state(object, stepped.object());
  report.collision_queries += outcome.queries;
  if (outcome.held_back) ++report.guards_tripped;
  states_[object].in_contact = !outcome.rows.empty();
  contacts_.note(object, states_[object], outcome.rows, h);
}

void Workbench::carry_free(double now, double h, AdvanceReport& report) {
  for (std::size_t i = 0; i < states_.size(); ++i) {
    if (!free_bodies_[i]) continue;
    carry(*free_bodies_[i], i, h, report);
    put_to_sleep_if_slow(i, now + h);
  }
}

void Workbench::put_to_sleep_if_slow(std::size_t object, double now) {
  BodyState& o = states_[object];
  o.asleep = false;
  const double speed = o.V_WO_W.linear.norm() + o.V_WO_W.angular.norm() * bounding_radius(body(object));
  const std::vector<ContactState>& touching = contacts_.touching(object);
  const bool on_something_awake = std::any_of(touching.begin(), touching.end(), [&](const ContactState& c) {
    const std::optional<std::size_t> other = find(c.other);
    return other && !states_[*other].asleep;
  });
  if (!o.in_contact || on_something_awake || speed > asleep_speed) slow_since_[object] = now;
  const bool away = o.X_WO.translation().norm() > world_limit;
  if (away || now - slow_since_[object] > asleep_after) {
    free_bodies_[object].reset();
    o.V_WO_W = Twist();
    o.asleep = true;
  }
}

}  // namespace spring_workbench
