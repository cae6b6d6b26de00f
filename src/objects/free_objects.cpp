#include "spring_workbench/objects/free_objects.h"

#include <algorithm>

#include "constants.h"
#include "spring_workbench/collision/support.h"
#include "spring_workbench/contact/contact_engines.h"
#include "spring_workbench/geometry/shape_queries.h"
#include "spring_workbench/scene/constants.h"

namespace spring_workbench::objects {

FreeObjects::FreeObjects(const scene::Scene& scene, int impact_bisections) : ObjectList(scene), contacts_(scene) {
  if (!with_contact()) return;
  collision_ = contact::open_collision_world(scene);
  contact_stepper_ = std::make_unique<contact::ContactStepper>(scene, *collision_, impact_bisections);
}

void FreeObjects::return_to_start() {
  ObjectList::return_to_start();
  contacts_.reset(states_.size());
  if (scene_.contact == scene::ContactMode::dynamic)
    dynamic_stepper_ = std::make_unique<contact::DynamicStepper>(scene_);
  free_.clear();
  objects_.clear();
  objects_.resize(states_.size());
  for (std::size_t i = 0; collision_ && i < states_.size(); ++i) {
    collision_->set_pose(scene_index(i), states_[i].X_WO);
  }
  if (with_contact() && scene_.gravity > 0.0) wake_unsupported();
}

void FreeObjects::begin(double now) {
  for (const std::size_t object : free_) {
    changes_.note(object);
    objects_[object].slow_since = now;
  }
}

bool FreeObjects::any_free() const { return !free_.empty() || (dynamic_stepper_ && dynamic_stepper_->others_awake()); }

void FreeObjects::take_state(std::size_t object, const motion::MotionState& s) {
  state(object).X_WO = s.X;
  states_[object].V_WO_W = s.velocity;
  if (collision_) collision_->set_pose(scene_index(object), s.X);
}

std::string FreeObjects::overlapped_body(std::size_t object, const RigidTransform& X_WO) const {
  return collision_ ? collision::overlapped_body(*collision_, scene_, scene_index(object), X_WO) : "";
}

void FreeObjects::wake_unsupported() {
  for (std::size_t i = 0; i < objects_.size(); ++i) {
    if (massless(i) || body(i).collision.empty() || !states_[i].asleep) continue;
    if (is_carried(*collision_, scene_index(i), states_[i].X_WO)) continue;
    set_free(i, Twist(), 0.0);
    wake_supported_by(i, 0.0);
  }
}

void FreeObjects::wake_supported_by(std::size_t object, double now) {
  if (!with_contact()) return;
  for (const std::size_t above : movable_on(*collision_, scene_, scene_index(object), states_[object].X_WO)) {
    const std::size_t other = object_of_[above];
    if (objects_[other].free_body || objects_[other].carried() || massless(other)) continue;
    set_free(other, states_[other].V_WO_W, now);
    wake_supported_by(other, now);
  }
}

void FreeObjects::start_free_flight(std::size_t object, double now) {
  bodies::BodyState& o = state(object);
  if (massless(object)) {
    o.asleep = true;
    o.V_WO_W = Twist();
    if (dynamic_stepper_) dynamic_stepper_->world().place(scene_index(object), o.X_WO, Twist(), false);
  } else {
    set_free(object, o.V_WO_W, now);
  }
}

void FreeObjects::set_free(std::size_t object, const Twist& V_WO_W, double now) {
  state(object).asleep = false;
  if (dynamic_stepper_) dynamic_stepper_->world().place(scene_index(object), states_[object].X_WO, V_WO_W, false);
  objects_[object].free_body = std::make_unique<bodies::FreeBody>(scene_index(object), body(object), scene_.gravity,
                                                                  states_[object].X_WO, V_WO_W);
  free_.insert(object);
  objects_[object].slow_since = now;
}

void FreeObjects::note(const contact::ContactOutcome& outcome, StepCounts& counts) {
  ++counts.steps;
  counts.collision_queries += outcome.queries;
  counts.note(outcome.time_lost, outcome.refused);
}

bool FreeObjects::carry(bodies::SteppedBody& stepped, std::size_t object, double h,
                        const contact::ContactStepper::MotionCheck& is_allowed, StepCounts& counts) {
  contact::ContactOutcome outcome;
  if (contact_stepper_) {
    if (!contact_stepper_->step(stepped, h, is_allowed, objects_[object].rows, outcome)) return false;
  } else {
    stepped.save(start_);
    if (stepped.advance(h, Wrench())) {
      stepped.accept();
    } else {
      stepped.restore(start_);
      stepped.follow_rigidly(h);
      outcome.refused = true;
      counts.time_lost += h;
    }
  }
  note(outcome, counts);
  take_state(object, stepped.object());
  states_[object].in_contact = !objects_[object].rows.empty();
  contacts_.note(object, states_, outcome.rows, h);
  return true;
}

bool FreeObjects::touches_moving_body(std::size_t object) const {
  const std::vector<contact::ContactState>& now = contacts_.touching(object);
  return std::any_of(now.begin(), now.end(), [&](const contact::ContactState& c) {
    const std::optional<std::size_t> other = find(c.other);
    return other && !states_[*other].asleep;
  });
}

void FreeObjects::put_to_sleep_if_slow(std::size_t object, double now) {
  bodies::BodyState& o = state(object);
  o.asleep = false;
  const double speed =
      o.V_WO_W.linear.norm() + o.V_WO_W.angular.norm() * geometry::bounding_radius(body(object).collision);
  if (!o.in_contact || touches_moving_body(object) || speed > scene::asleep_speed) objects_[object].slow_since = now;
  if (o.X_WO.translation().norm() > world_limit || now - objects_[object].slow_since > asleep_after) {
    objects_[object].free_body.reset();
    free_.erase(object);
    o.V_WO_W = Twist();
    o.asleep = true;
  }
}

}  // namespace spring_workbench::objects
