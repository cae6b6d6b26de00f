#include "spring_workbench/objects/objects.h"

#include <algorithm>
#include <array>
#include <map>
#include <utility>

#include "free_pairs.h"

namespace spring_workbench::objects {

Objects::Objects(const scene::Scene& scene, int impact_bisections) : FreeObjects(scene, impact_bisections) {
  if (scene.contact == scene::ContactMode::dynamic) {
    pairs_ = std::make_unique<FreePairs>(scene, *collision_, *contact_stepper_);
  }
  reset();
}

Objects::~Objects() = default;

void Objects::reset() {
  in_contact_.clear();
  return_to_start();
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
    bodies::BodyState& o = state(i) = before.states_[*same];
    o.highlighted = false;
    objects_[i].grasping = was.grasping;
    take_state(i, {o.X_WO, o.V_WO_W, {}});
    if (!o.held && (!o.asleep || massless(i) != before.massless(*same))) {
      start_free_flight(i, now);
    } else if (dynamic_stepper_) {
      dynamic_stepper_->world().place(scene_index(i), o.X_WO, o.V_WO_W, false);
    }
    objects_[i].slow_since = was.slow_since;
    contacts_.copy(i, before.contacts_, *same);
    if (before.in_contact_.count(*same) > 0) in_contact_.insert(i);
  }
}

void Objects::hold(std::size_t object, Grip grip, double now) {
  ++(grip == Grip::grasp ? objects_[object].grasping : objects_[object].pushing);
  objects_[object].free_body.reset();
  free_.erase(object);
  bodies::BodyState& o = state(object);
  o.held = objects_[object].grasping > 0;
  if (o.held) o.highlighted = false;
  o.asleep = false;
  if (scene_.contact == scene::ContactMode::stop)
    wake_supported_by(object, now);  // in Bullet's world they wake by themselves
}

void Objects::let_go(std::size_t object, Grip grip, bool thrown, double now) {
  Object& carried = objects_[object];
  --(grip == Grip::grasp ? carried.grasping : carried.pushing);
  bodies::BodyState& o = state(object);
  o.held = carried.grasping > 0;
  if (carried.grasping + carried.pushing > 0) return;
  if (!thrown) o.V_WO_W = Twist();
  wake_supported_by(object, now);
  start_free_flight(object, now);
}

void Objects::place(std::size_t object, const RigidTransform& X_WO, double now) {
  wake_supported_by(object, now);
  take_state(object, {X_WO, Twist(), {}});
  start_free_flight(object, now);
}

void Objects::step(const std::vector<Carried>& held, double now, double h, StepCounts& counts) {
  contacts_.begin_step(h);
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
  std::vector<Carried> carried = held, among_others;
  for (const std::size_t object : free_) carried.push_back({object, objects_[object].free_body.get()});
  std::vector<std::size_t> moving;
  for (const Carried& c : carried) moving.push_back(scene_index(c.object));
  if (!free_.empty()) find_moving_bodies(moving, h);
  std::set<std::size_t> stepped_objects;  // objects already stepped, alone or in pairs
  for (const Carried& c : carried) {
    if (stepped_objects.count(c.object) > 0) continue;
    Object& object = objects_[c.object];
    const bodies::BodyState& o = state(c.object);
    std::vector<std::size_t> near;
    const auto among_fixed = [&](const RigidTransform& X0_WO, const RigidTransform& X1_WO) {
      near = world.movable_near(scene_index(c.object), X0_WO, X1_WO, h, moving, scene_.bodies.size());
      // Objects already stepped stayed clear of this one.
      const auto is_stepped = [&](std::size_t other) { return stepped_objects.count(object_of_[other]) > 0; };
      near.erase(std::remove_if(near.begin(), near.end(), is_stepped), near.end());
      return near.empty();
    };
    if (carry(*c.body, c.object, h, among_fixed, counts)) {
      if (object.free_body) put_to_sleep_if_slow(c.object, now + h);
      in_contact_.erase(c.object);  // its contacts are already recorded
      world.place(scene_index(c.object), o.X_WO, o.V_WO_W, false);
      stepped_objects.insert(c.object);
      continue;
    }
    if (object.free_body && near.size() == 1 &&
        carry_pair(c.object, object_of_[near[0]], stepped_objects, now, h, counts))
      continue;
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
  for (const std::size_t object : stepped_objects) {
    if (states_[object].in_contact) in_contact_.insert(object);
  }
}

void Objects::find_moving_bodies(const std::vector<std::size_t>& carried, double h) {
  const rigid_bodies::RigidWorld& world = dynamic_stepper_->world();
  pairs_->begin(h);
  for (const std::size_t body : carried) {
    const bodies::BodyState& o = states_[object_of_[body]];
    pairs_->add_moving(body, o.X_WO, o.V_WO_W);
  }
  for (const std::size_t body : world.bodies_near()) {
    if (world.awake(body)) pairs_->add_moving(body, world.pose(body), world.velocity(body));
  }
}

bool Objects::carry_pair(std::size_t object, std::size_t other, std::set<std::size_t>& stepped_objects, double now,
                         double h, StepCounts& counts) {
  const bool sleeps = states_[other].asleep;
  if (massless(other) || objects_[other].carried() || (!sleeps && !objects_[other].free_body)) return false;
  // The step uses the frame of the heavier body, which turns least.
  const bool lighter = body(object).mass_properties.mass < body(other).mass_properties.mass;
  const std::array<std::size_t, 2> both = lighter ? std::array{object, other} : std::array{other, object};
  const auto body_of = [&](std::size_t o) {
    return bodies::FreeBody(scene_index(o), body(o), scene_.gravity, states_[o].X_WO, states_[o].V_WO_W);
  };
  bodies::BodyPair pair(body_of(both[0]), body_of(both[1]));
  std::array<std::vector<contact::ContactRow>, 2> rows{objects_[both[0]].rows, {}};
  contact::ContactOutcome outcome;
  if (!pairs_->step(pair, rows[0], outcome)) return false;
  ++counts.steps_among_movable;
  note(outcome, counts);
  const std::array<std::vector<contact::ContactRow>, 2> reported{outcome.rows, {}};
  for (std::size_t i = 0; i < 2; ++i) {
    const std::size_t o = both[i];
    if (o == other && sleeps && outcome.rows.empty()) continue;  // it stays asleep
    const bodies::FreeBody& moved = i == 0 ? pair.first() : pair.second();
    const motion::MotionState s = moved.object();
    if (!objects_[o].free_body) set_free(o, s.velocity, now);
    *objects_[o].free_body = moved;
    take_state(o, s);
    dynamic_stepper_->world().place(scene_index(o), s.X, s.velocity, false);
    states_[o].in_contact = !rows[0].empty();
    objects_[o].rows = rows[i];
    objects_[o].slow_since = now + h;
    in_contact_.erase(o);
    stepped_objects.insert(o);
  }
  for (std::size_t i = 0; i < 2; ++i) {  // slip is relative, so both states come first
    if (stepped_objects.count(both[i]) != 0) contacts_.note(both[i], states_, reported[i], h);
  }
  return true;
}

void Objects::step_together(const std::vector<Carried>& held, const std::vector<std::size_t>& moving, double now,
                            double h, StepCounts& counts) {
  std::vector<bodies::SteppedBody*> bodies;
  for (const Carried& c : held) bodies.push_back(c.body);
  const contact::DynamicStepper::Outcome outcome = dynamic_stepper_->step(bodies, h);
  counts.steps += outcome.substeps;
  counts.steps_among_movable += outcome.substeps;
  counts.steps_unsolved += outcome.unsolved;
  counts.path_error = std::max(counts.path_error, outcome.path_error);
  counts.collision_queries += outcome.substeps;
  counts.note(outcome.time_lost, outcome.refused);
  for (const Carried& c : held) take_state(c.object, c.body->object());
  const rigid_bodies::RigidWorld& world = dynamic_stepper_->world();
  for (const std::size_t near : world.bodies_near()) {
    const std::size_t object = object_of_[near];
    if (!scene_.bodies[near].movable || objects_[object].carried()) continue;
    take_state(object, {world.pose(near), world.velocity(near), {}});
    states_[object].asleep = !world.awake(near);
  }
  note_world_contacts(h);
  for (const std::size_t body : dynamic_stepper_->alone(moving, h)) {
    set_free(object_of_[body], states_[object_of_[body]].V_WO_W, now + h);
  }
}

void Objects::note_world_contacts(double h) {
  std::map<std::size_t, std::vector<contact::ContactRow>> rows;
  for (const std::size_t object : in_contact_) rows[object];
  for (const rigid_bodies::WorldContact& c : dynamic_stepper_->contacts()) {
    rows[object_of_[c.body]].push_back(contact::row_of(c, h));
  }
  for (auto& [object, of_object] : rows) {
    if (of_object.empty() && states_[object].asleep) continue;
    state(object).in_contact = !of_object.empty();
    contacts_.note(object, states_, of_object, h);
    if (of_object.empty()) {
      in_contact_.erase(object);
    } else {
      in_contact_.insert(object);
    }
    objects_[object].rows = std::move(of_object);
  }
}

std::vector<std::size_t> Objects::Archive::moved() const {
  std::vector<std::size_t> moved;
  for (const std::size_t i : of_.changes_.since(of_.reset_revision_)) {
    const Object& object = of_.objects_[i];
    const bool unchanged_since_reset = !object.free_body && object.rows.empty() && !object.carried() &&
                                       object.slow_since == 0.0 &&
                                       same_bits(of_.states_[i], bodies::at_start(of_.body(i)));
    if (!unchanged_since_reset) moved.push_back(i);
  }
  return moved;
}

void Objects::Archive::archive(math::StateArchive& state) {
  const std::vector<std::size_t> present = moved();
  std::vector<std::size_t> kept = present;
  state(kept);
  for (std::size_t k = 0; state.is_restoring() && k < present.size(); ++k) {
    of_.objects_[present[k]] = Object();
    of_.take_state(present[k], {of_.body(present[k]).X_WO, Twist(), {}});
    of_.states_[present[k]] = bodies::at_start(of_.body(present[k]));
  }
  archive(state, kept);
}

void Objects::Archive::archive(math::StateArchive& state, const std::vector<std::size_t>& some) {
  for (const std::size_t i : some) {
    Object& object = of_.objects_.at(i);
    bool flies = object.free_body != nullptr;
    state(of_.states_[i], object.rows, object.grasping, object.pushing, object.slow_since, flies);
    if (state.is_restoring()) {
      const bodies::BodyState& o = of_.state(i);
      of_.take_state(i, {o.X_WO, o.V_WO_W, {}});
      object.free_body = nullptr;
      if (flies) {
        object.free_body =
            std::make_unique<bodies::FreeBody>(of_.scene_index(i), of_.body(i), of_.scene_.gravity, o.X_WO, o.V_WO_W);
      }
    }
    if (flies) state(*object.free_body);
  }
  state(of_.contacts_, of_.highlighted_, of_.free_, of_.in_contact_);
  if (of_.dynamic_stepper_) state(*of_.dynamic_stepper_);
}

bool Objects::rests(std::size_t object) const {
  if (dynamic_stepper_) return !any_free();
  return states_[object].asleep || !touches_moving_body(object);  // for others, it is where it is
}

}  // namespace spring_workbench::objects
