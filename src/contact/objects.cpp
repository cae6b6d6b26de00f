#include "spring_workbench/contact/objects.h"

#include <algorithm>
#include <map>
#include <utility>

#include "constants.h"
#include "spring_workbench/collision/support.h"
#include "spring_workbench/contact/contact_engines.h"
#include "spring_workbench/geometry/shape_queries.h"
#include "spring_workbench/scene/constants.h"

namespace spring_workbench::contact {
Objects::Objects(const scene::Scene& scene, int bisection_levels) : ObjectList(scene), contacts_(scene) {
  if (with_contact()) {
    collision_ = open_collision_world(scene);
    contact_stepper_ = std::make_unique<ContactStepper>(scene, *collision_, bisection_levels);
  }
  reset();
}

void Objects::reset() {
  put_back();
  contacts_.reset(states_.size());
  if (scene_.contact == scene::ContactMode::dynamic) dynamic_stepper_ = std::make_unique<DynamicStepper>(scene_);
  free_.clear();
  in_contact_.clear();
  objects_.clear();
  objects_.resize(states_.size());
  for (std::size_t i = 0; collision_ && i < states_.size(); ++i) {
    collision_->set_pose(scene_index(i), states_[i].X_WO);
  }
  if (with_contact() && scene_.gravity > 0.0) let_fall();
}

void Objects::begin(double now) {
  for (const std::size_t object : free_) objects_[object].slow_since = now;
}

void Objects::continue_from(const Objects& before, double now) {
  for (std::size_t i = 0; i < objects_.size(); ++i) {
    const std::optional<std::size_t> same = before.find(states_[i].name);
    if (!same) {
      place(i, body(i).X_WO, now);
      continue;
    }
    const Object& was = before.objects_[*same];
    objects_[i].free_body.reset();
    free_.erase(i);
    states_[i] = before.states_[*same];
    states_[i].highlighted = false;
    objects_[i].grasping = was.grasping;
    const bodies::BodyState& o = states_[i];
    take_state(i, {o.X_WO, o.V_WO_W, {}});
    if (!o.asleep && !o.held) {
      let_fly(i, now);
    } else if (dynamic_stepper_) {
      dynamic_stepper_->world().place(scene_index(i), o.X_WO, o.V_WO_W, false);
    }
    objects_[i].slow_since = was.slow_since;
    contacts_.take(i, before.contacts_, *same);
    if (before.in_contact_.count(*same) > 0) in_contact_.insert(i);
  }
}

std::string Objects::inside_of(std::size_t object, const RigidTransform& X_WO) const {
  return collision_ ? collision::inside_of(*collision_, scene_, scene_index(object), X_WO) : "";
}

void Objects::let_fall() {
  for (std::size_t i = 0; i < objects_.size(); ++i) {
    if (massless(i) || body(i).collision.empty() || !states_[i].asleep) continue;
    if (is_carried(*collision_, scene_index(i), states_[i].X_WO)) continue;
    set_free(i, Twist(), 0.0);
    wake_what_lies_on(i, 0.0);
  }
}

bool Objects::any_free() const { return !free_.empty() || (dynamic_stepper_ && dynamic_stepper_->others_awake()); }

void Objects::take_state(std::size_t object, const motion::MotionState& s) {
  states_[object].X_WO = s.X;
  states_[object].V_WO_W = s.velocity;
  if (collision_) collision_->set_pose(scene_index(object), s.X);
}

void Objects::hold(std::size_t object, Grip grip, double now) {
  ++(grip == Grip::grasp ? objects_[object].grasping : objects_[object].pushing);
  objects_[object].free_body.reset();
  free_.erase(object);
  bodies::BodyState& o = states_[object];
  o.held = objects_[object].grasping > 0;
  if (o.held) o.highlighted = false;
  o.asleep = false;
  if (scene_.contact == scene::ContactMode::stop) wake_what_lies_on(object, now);  // Bullet's wake by themselves
}

void Objects::let_go(std::size_t object, Grip grip, bool thrown, double now) {
  Object& carried = objects_[object];
  --(grip == Grip::grasp ? carried.grasping : carried.pushing);
  bodies::BodyState& o = states_[object];
  o.held = carried.grasping > 0;
  if (carried.grasping + carried.pushing > 0) return;
  if (!thrown || massless(object)) o.V_WO_W = Twist();
  let_fly(object, now);
}

void Objects::place(std::size_t object, const RigidTransform& X_WO, double now) {
  take_state(object, {X_WO, Twist(), {}});
  let_fly(object, now);
}

void Objects::let_fly(std::size_t object, double now) {
  bodies::BodyState& o = states_[object];
  if (massless(object)) {
    o.asleep = true;
    if (dynamic_stepper_) dynamic_stepper_->world().place(scene_index(object), o.X_WO, Twist(), false);
  } else {
    set_free(object, o.V_WO_W, now);
  }
}

void Objects::set_free(std::size_t object, const Twist& V_WO_W, double now) {
  states_[object].asleep = false;
  if (dynamic_stepper_) dynamic_stepper_->world().place(scene_index(object), states_[object].X_WO, V_WO_W, false);
  objects_[object].free_body = std::make_unique<bodies::FreeBody>(scene_index(object), body(object), scene_.gravity,
                                                                  states_[object].X_WO, V_WO_W);
  free_.insert(object);
  objects_[object].slow_since = now;
}

void Objects::wake_what_lies_on(std::size_t object, double now) {
  if (!with_contact()) return;
  for (const std::size_t above : movable_on(*collision_, scene_, scene_index(object), states_[object].X_WO)) {
    const std::size_t other = object_of_[above];
    if (!states_[other].asleep || states_[other].held || massless(other)) continue;
    set_free(other, Twist(), now);
    wake_what_lies_on(other, now);
  }
}

bool Objects::carry(bodies::SteppedBody& stepped, std::size_t object, double h, const ContactStepper::MayGo& may_go,
                    StepCounts& counts) {
  ContactOutcome outcome;
  if (contact_stepper_) {
    if (!contact_stepper_->step(stepped, h, may_go, objects_[object].rows, outcome)) return false;
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
  ++counts.steps;
  take_state(object, stepped.object());
  counts.collision_queries += outcome.queries;
  counts.note(outcome.time_lost, outcome.refused);
  states_[object].in_contact = !objects_[object].rows.empty();
  contacts_.note(object, states_[object], outcome.rows, h);
  return true;
}

void Objects::step(const std::vector<Carried>& held, double now, double h, StepCounts& counts) {
  if (dynamic_stepper_) return step_among_movable(held, now, h, counts);
  const auto anywhere = [](const RigidTransform&, const RigidTransform&) { return true; };
  for (const Carried& c : held) carry(*c.body, c.object, h, anywhere, counts);
  const std::set<std::size_t> free = free_;
  for (const std::size_t i : free) {
    carry(*objects_[i].free_body, i, h, anywhere, counts);
    put_to_sleep_if_slow(i, now + h);
  }
}

void Objects::step_among_movable(const std::vector<Carried>& held, double now, double h, StepCounts& counts) {
  rigid_bodies::RigidWorld& world = dynamic_stepper_->world();
  std::vector<Carried> carried = held, among_others, alone;
  for (const std::size_t object : free_) carried.push_back({object, objects_[object].free_body.get()});
  std::vector<std::size_t> moving;
  for (const Carried& c : carried) moving.push_back(scene_index(c.object));
  for (const Carried& c : carried) {
    Object& object = objects_[c.object];
    const bodies::BodyState& o = states_[c.object];
    const auto among_fixed = [&](const RigidTransform& X0_WO, const RigidTransform& X1_WO) {
      return !world.near_movable(scene_index(c.object), X0_WO, X1_WO, h, moving);
    };
    if (carry(*c.body, c.object, h, among_fixed, counts)) {
      if (object.free_body) put_to_sleep_if_slow(c.object, now + h);
      in_contact_.erase(c.object);  // its contacts are noted already
      world.place(scene_index(c.object), o.X_WO, o.V_WO_W, false);
      alone.push_back(c);
      continue;
    }
    object.rows.clear();
    if (!object.free_body) {
      among_others.push_back(c);
      continue;
    }
    object.free_body.reset();
    free_.erase(c.object);
    dynamic_stepper_->set_free(scene_index(c.object), o.X_WO, o.V_WO_W);
  }
  if (!among_others.empty() || dynamic_stepper_->others_awake()) step_together(among_others, moving, now, h, counts);
  for (const Carried& c : alone) {
    if (states_[c.object].in_contact) in_contact_.insert(c.object);
  }
}

void Objects::step_together(const std::vector<Carried>& held, const std::vector<std::size_t>& moving, double now,
                            double h, StepCounts& counts) {
  std::vector<bodies::SteppedBody*> bodies;
  for (const Carried& c : held) bodies.push_back(c.body);
  const DynamicStepper::Outcome outcome = dynamic_stepper_->step(bodies, h);
  counts.steps += outcome.substeps;
  counts.steps_among_movable += outcome.substeps;
  counts.steps_unsolved += outcome.unsolved;
  counts.collision_queries += outcome.substeps;
  counts.note(outcome.time_lost, outcome.refused);
  for (const Carried& c : held) take_state(c.object, c.body->object());
  const rigid_bodies::RigidWorld& world = dynamic_stepper_->world();
  for (const std::size_t near : world.bodies_near()) {
    const std::size_t object = object_of_[near];
    if (!scene_.bodies[near].movable || objects_[object].grasping + objects_[object].pushing > 0) continue;
    take_state(object, {world.pose(near), world.velocity(near), {}});
    states_[object].asleep = !world.awake(near);
  }
  note_world_contacts(h);
  for (const std::size_t body : dynamic_stepper_->alone(moving, h)) {
    set_free(object_of_[body], states_[object_of_[body]].V_WO_W, now + h);
  }
}

void Objects::note_world_contacts(double h) {
  std::map<std::size_t, std::vector<ContactRow>> rows;
  for (const std::size_t object : in_contact_) rows[object];
  for (const rigid_bodies::WorldContact& c : dynamic_stepper_->contacts()) {
    rows[object_of_[c.body]].push_back(row_of(c, h));
  }
  for (auto& [object, of_object] : rows) {
    if (of_object.empty() && states_[object].asleep) continue;
    states_[object].in_contact = !of_object.empty();
    contacts_.note(object, states_[object], of_object, h);
    if (of_object.empty()) {
      in_contact_.erase(object);
    } else {
      in_contact_.insert(object);
    }
    objects_[object].rows = std::move(of_object);
  }
}

void Objects::exchange(math::StateArchive& state) {
  for (std::size_t i = 0; i < states_.size(); ++i) {
    Object& object = objects_[i];
    bool flies = object.free_body != nullptr;
    state(states_[i], object.rows, object.grasping, object.pushing, object.slow_since, flies);
    if (state.sets()) {
      const bodies::BodyState& o = states_[i];
      if (collision_) collision_->set_pose(scene_index(i), o.X_WO);
      object.free_body =
          !flies ? nullptr
                 : std::make_unique<bodies::FreeBody>(scene_index(i), body(i), scene_.gravity, o.X_WO, o.V_WO_W);
    }
    if (flies) state(*object.free_body);
  }
  state(contacts_, highlighted_, free_, in_contact_);
  if (dynamic_stepper_) state(*dynamic_stepper_);
}

bool Objects::rests(std::size_t object) const { return dynamic_stepper_ ? !any_free() : !touches_what_moves(object); }

bool Objects::touches_what_moves(std::size_t object) const {
  const std::vector<ContactState>& now = contacts_.touching(object);
  return std::any_of(now.begin(), now.end(), [&](const ContactState& c) {
    const std::optional<std::size_t> other = find(c.other);
    return other && !states_[*other].asleep;
  });
}

void Objects::put_to_sleep_if_slow(std::size_t object, double now) {
  bodies::BodyState& o = states_[object];
  o.asleep = false;
  const double speed =
      o.V_WO_W.linear.norm() + o.V_WO_W.angular.norm() * geometry::bounding_radius(body(object).collision);
  if (!o.in_contact || touches_what_moves(object) || speed > scene::asleep_speed) objects_[object].slow_since = now;
  if (o.X_WO.translation().norm() > world_limit || now - objects_[object].slow_since > asleep_after) {
    objects_[object].free_body.reset();
    free_.erase(object);
    o.V_WO_W = Twist();
    o.asleep = true;
  }
}

}  // namespace spring_workbench::contact
