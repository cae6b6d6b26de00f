#include "spring_workbench/simulation/simulation.h"

#include <algorithm>
#include <cmath>
#include <deque>
#include <utility>

#include "contact_stepper.h"
#include "fork_body.h"
#include "free_body.h"
#include "spring_workbench/config/yaml_fields.h"
#include "spring_workbench/math/so3.h"
#include "spring_workbench/rod/shape_model.h"
#include "spring_workbench/scene/geometry.h"
#include "spring_workbench/tools/calibration.h"
#include "spring_workbench/tools/grasp_selection.h"

namespace spring_workbench {
namespace {

constexpr double same_time = 1e-9;         ///< [s]; stamps nearer to each other are one
constexpr double asleep_speed = 2e-3;      ///< [m/s]; a body in contact that stays slower …
constexpr double asleep_after = 0.2;       ///< [s] … this long goes to sleep
constexpr double support_gap = 1e-4;       ///< [m]; what is nearer below carries
constexpr double world_limit = 100.0;      ///< [m] from the origin; a body that flies further stops there
constexpr double point_mass_radius = 1e-2; ///< of the fork's length: radius of gyration of a point mass

/// Whether the list has a contact of the same two bodies.
bool contains_pair(const std::vector<ContactState>& list, const ContactState& c) {
  return std::any_of(list.begin(), list.end(),
                     [&](const ContactState& other) { return other.object == c.object && other.other == c.other; });
}

struct ButtonEvent {
  double t;
  bool pressed;
};

}  // namespace

struct Simulation::Impl {
  Scene scene;
  SimulationSettings settings;
  bool with_contact = false;
  std::unique_ptr<CollisionWorld> collision;
  std::unique_ptr<ContactStepper> contact_stepper;

  bool started = false;
  double now = 0.0;
  PoseTrack track;
  std::deque<ButtonEvent> buttons;
  GraspSelection hand;
  bool grasped_by_name = false;

  std::vector<std::size_t> movable;                  ///< scene index of every object
  std::vector<BodyState> objects;                  ///< parallel to `movable`
  std::vector<std::vector<ContactRow>> rows;         ///< parallel to `movable`
  std::vector<std::unique_ptr<FreeBody>> free_bodies; ///< parallel; null while held or asleep
  std::vector<double> slow_since;
  std::unique_ptr<ForkBody> fork;                    ///< while something is held
  std::size_t held = 0;                              ///< index into `movable`
  std::vector<std::vector<ContactState>> touching;    ///< parallel: contacts after the last step; a sleeper keeps its own
  std::vector<ContactState> ended;                   ///< since they were told last
  std::vector<ContactState> contacts;                ///< of the last call of advance
  RigidTransform X_WH = RigidTransform::Identity();
  AdvanceReport report;

  Impl(const Scene& s, const SimulationSettings& set);
  void place_objects();
  const Body& body(std::size_t object) const { return scene.bodies[movable[object]]; }

  void advance(double t_end);
  void step(double h);
  void apply_buttons();
  void select();
  void grasp(std::size_t object, const std::optional<RigidTransform>& X_OE, bool follow);
  void let_go(bool thrown);
  void wake_what_lies_on(std::size_t object);
  HeldBody make_held(std::size_t object, const RigidTransform& X_OE);
  void calibrate(HeldBody& held_body);
  void carry(SteppedBody& stepped, std::size_t object, double h);
  void take_state(std::size_t object, const MotionState& s);
  void note_contacts(std::size_t object, const ContactOutcome& outcome, double h);
  void note_phases(const std::vector<ContactState>& before);
  bool busy() const;
  void fill_parts();
  double elastic_energy() const { return fork ? fork->held().elastic_energy(fork->time(), fork->state()) : 0.0; }
};

Simulation::Impl::Impl(const Scene& s, const SimulationSettings& set)
    : scene(s), settings(set), track(set.dropout_after) {
  if (settings.gravity >= 0.0) scene.gravity = settings.gravity;
  if (settings.force_scale > 0.0) scene.force_scale = settings.force_scale;
  if (settings.contact == "none") scene.contact = ContactMode::none;
  if (settings.contact == "stop") scene.contact = ContactMode::stop;
  if (scene.contact == ContactMode::dynamic) {
    refuse(scene.path, "contact", "dynamic", "none or stop: this version has no world of movable neighbours");
  }
  const std::string tool = settings.tool.empty() ? scene.tool : settings.tool;
  if (tool != "spring_fork") refuse(scene.path, "tool", tool, "spring_fork: this version has no other tool");
  if (!settings.grasp.object.empty()) {
    const std::optional<std::size_t> index = find_body(scene, settings.grasp.object);
    if (!index || !scene.bodies[*index].movable) {
      std::vector<std::string> names;
      for (const Body& b : scene.bodies) {
        if (b.movable) names.push_back(b.name);
      }
      refuse(scene.path, "grasp.object", settings.grasp.object, "a movable object of the scene: " + join(names));
    }
  }
  if (settings.grasp.X_OE && !settings.grasp.start_follow) {
    refuse(scene.path, "grasp.tip_in_object", "(a pose)", "used with start.follow: true, so that the object can move to it");
  }
  with_contact = scene.contact != ContactMode::none;
  make_integrator(settings.dynamics.integrator);
  make_shape_model(settings.fork.shape, settings.fork.length);
  for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
    if (scene.bodies[i].movable) movable.push_back(i);
  }
  if (with_contact) {
    collision = std::make_unique<CollisionWorld>(scene);
    contact_stepper = std::make_unique<ContactStepper>(scene, *collision, settings.bisection_levels);
  }
  X_WH = scene.X_WH_start;
  place_objects();
}

void Simulation::Impl::place_objects() {
  fork.reset();
  contacts.clear();
  touching.assign(movable.size(), {});
  ended.clear();
  objects.assign(movable.size(), BodyState());
  rows.assign(movable.size(), {});
  slow_since.assign(movable.size(), 0.0);
  free_bodies.clear();
  free_bodies.resize(movable.size());
  for (std::size_t i = 0; i < movable.size(); ++i) {
    objects[i].name = body(i).name;
    objects[i].X_WO = body(i).X_WO;
    if (collision) collision->set_pose(movable[i], body(i).X_WO);
  }
}

void Simulation::Impl::take_state(std::size_t object, const MotionState& s) {
  objects[object].X_WO = s.X;
  objects[object].V_WO_W = s.velocity;
  if (collision) collision->set_pose(movable[object], s.X);
}

HeldBody Simulation::Impl::make_held(std::size_t object, const RigidTransform& X_OE) {
  const Body& b = body(object);
  BodyInertia inertia{b.mass_properties.mass, b.mass_properties.inertia_O, X_OE};
  if (settings.dynamics.inertia == "point_mass") {
    // The paper's I = r² m: all of the mass at its centre. A small radius keeps the rotation about that point defined.
    const double radius = point_mass_radius * settings.fork.length;
    inertia.inertia_O = inertia.mass * radius * radius * Matrix3d::Identity();
  }
  const bool massless = !(inertia.mass > 0.0);
  if (massless) {
    inertia.mass = 1.0;  // of no effect: nothing bends a fork that carries nothing
    inertia.inertia_O.setIdentity();
  }
  HeldBody held_body(make_shape_model(settings.fork.shape, settings.fork.length), inertia, scene.gravity);
  if (settings.grasp.calibrate && !massless) {
    calibrate(held_body);
  } else {
    held_body.set_springs(settings.fork.stiffness, settings.fork.damping_ratio);
  }
  const StrainState zero{StrainVector::Zero(held_body.shape().size()), StrainVector::Zero(held_body.shape().size())};
  held_body.set_dofs(massless ? ForkDofs{false, false, false} : settings.fork.dofs, now,
                     settings.fork.switch_off_time, zero);
  return held_body;
}

/// Springs for the object as it is grasped; in every direction the damping ratio that is set for the family.
void Simulation::Impl::calibrate(HeldBody& held_body) {
  const ForkCalibration fork_for_it =
      calibrated_fork(settings.fork.shape, settings.fork.length, held_body.body(), scene.gravity);
  const PerFamily& ratio = settings.fork.damping_ratio;
  const PerFamily& c = fork_for_it.damping;
  settings.fork.stiffness = fork_for_it.stiffness;
  held_body.set_springs_and_dampers(fork_for_it.stiffness, {ratio.stretch * c.stretch, ratio.bend * c.bend,
                                                            ratio.torsion * c.torsion});
}

void Simulation::Impl::grasp(std::size_t object, const std::optional<RigidTransform>& X_OE, bool follow) {
  const MassProperties& mass = body(object).mass_properties;
  if (settings.grasp.calibrate && follow && mass.mass > 0.0) {  // the object comes to the tip, wherever that is
    settings.fork.length = calibrated_length({mass.mass, mass.inertia_O, RigidTransform::Identity()});
  }
  RigidTransform X_HE = RigidTransform::Identity();
  X_HE.translation().z() = settings.fork.length;
  const MotionSegment& segment = track.segment(now);
  const MotionState hand_now = segment.at(now);
  const RigidTransform X_WE = hand_now.X * X_HE;
  const RigidTransform G = X_OE ? *X_OE : RigidTransform(objects[object].X_WO.inverse() * X_WE);
  held = object;
  fork = std::make_unique<ForkBody>(movable[object], make_held(object, G), make_integrator(settings.dynamics.integrator),
                                    now);
  fork->set_hand(segment, now);
  const Twist before = objects[object].V_WO_W;
  // Strain is zero now. The object keeps its motion as far as the fork lets it; one that follows starts with the hand's.
  if (!follow && fork->held().size() > 0) fork->take_twist(before);
  free_bodies[object].reset();
  rows[object].clear();
  objects[object].held = true;
  objects[object].highlighted = false;
  objects[object].asleep = false;
  wake_what_lies_on(object);
  take_state(object, fork->object());
}

/// Sleepers that rest on `object`, and on one another, are free to fall.
void Simulation::Impl::wake_what_lies_on(std::size_t object) {
  if (!collision) return;
  std::vector<ContactPoint> found;
  for (std::size_t i = 0; i < objects.size(); ++i) {
    if (i == object || !objects[i].asleep || objects[i].held || !(body(i).mass_properties.mass > 0.0)) continue;
    RigidTransform lowered = objects[i].X_WO;
    lowered.translation().z() -= support_gap;
    found.clear();
    collision->find_contacts(movable[i], lowered, 0.0, found);
    const bool rests_on_it = std::any_of(found.begin(), found.end(), [&](const ContactPoint& c) {
      return c.other == movable[object] && c.n_W.z() > 0.1;
    });
    if (!rests_on_it) continue;
    free_bodies[i] = std::make_unique<FreeBody>(movable[i], body(i), scene.gravity, objects[i].X_WO, Twist());
    slow_since[i] = now;
    objects[i].asleep = false;
    wake_what_lies_on(i);
  }
}

void Simulation::Impl::let_go(bool thrown) {
  if (!fork) return;
  BodyState& o = objects[held];
  o.held = false;
  if (!thrown) o.V_WO_W = Twist();
  const bool massless = !(body(held).mass_properties.mass > 0.0);
  if (massless) {
    o.V_WO_W = Twist();
    o.asleep = true;
  } else {
    free_bodies[held] = std::make_unique<FreeBody>(movable[held], body(held), scene.gravity, o.X_WO, o.V_WO_W);
    slow_since[held] = now;
  }
  fork.reset();
}

void Simulation::Impl::select() {
  for (BodyState& o : objects) o.highlighted = false;
  hand.set_inserted(std::nullopt);
  if (fork || track.empty() || now < track.begin() - same_time) return;
  const Vector3d tip = X_WH * Vector3d(0.0, 0.0, settings.fork.length);
  double nearest = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < objects.size(); ++i) {
    const double distance = (objects[i].X_WO.translation() - tip).norm();
    if (distance < nearest && contains(body(i), objects[i].X_WO.inverse() * tip)) {
      nearest = distance;
      hand.set_inserted(i);
    }
  }
  if (hand.inserted() && settings.grasp.object.empty()) objects[*hand.inserted()].highlighted = true;
}

void Simulation::Impl::apply_buttons() {
  if (!settings.grasp.object.empty()) {
    if (!grasped_by_name && !track.empty() && now >= track.begin() - same_time) {
      for (std::size_t i = 0; i < objects.size(); ++i) {
        if (objects[i].name == settings.grasp.object) grasp(i, settings.grasp.X_OE, settings.grasp.start_follow);
      }
      grasped_by_name = true;
    }
    return;
  }
  while (!buttons.empty() && buttons.front().t <= now + same_time) {
    const bool pressed = buttons.front().pressed;
    buttons.pop_front();
    switch (hand.set_button(pressed, fork != nullptr)) {
      case GraspEvent::grasp: grasp(*hand.inserted(), std::nullopt, false); break;
      case GraspEvent::release: let_go(settings.grasp.release == "thrown"); break;
      case GraspEvent::none: break;
    }
  }
}

void Simulation::Impl::note_contacts(std::size_t object, const ContactOutcome& outcome, double h) {
  report.collision_queries += outcome.queries;
  if (outcome.held_back) ++report.guards_tripped;
  const BodyState& o = objects[object];
  objects[object].in_contact = !outcome.rows.empty();
  std::vector<ContactState> now_touching;
  for (const ContactRow& row : outcome.rows) {
    ContactState c;
    c.object = o.name;
    c.other = row.point.other == CollisionWorld::bench ? "workbench" : scene.bodies[row.point.other].name;
    c.p_W = row.point.p_W;
    c.n_W = row.point.n_W;
    c.depth = std::max(0.0, -row.gap);
    c.force = std::max(0.0, row.load_W.dot(row.point.n_W));
    c.impulse = h * c.force;
    const Vector3d v = o.V_WO_W.linear + o.V_WO_W.angular.cross(row.point.p_W - o.X_WO.translation());
    c.slip_speed = (v - row.point.n_W * v.dot(row.point.n_W)).norm();
    now_touching.push_back(c);
  }
  // What was touched and is no more, until it has been told.
  for (ContactState& c : touching[object]) {
    if (contains_pair(now_touching, c)) continue;
    c.impulse = c.force = 0.0;
    ended.push_back(c);
  }
  touching[object] = std::move(now_touching);
}

/// By pair of bodies: which contacts are new since the last call, which went on, which ended.
void Simulation::Impl::note_phases(const std::vector<ContactState>& before) {
  contacts.clear();
  for (const std::vector<ContactState>& of_object : touching) contacts.insert(contacts.end(), of_object.begin(), of_object.end());
  for (ContactState& c : contacts) c.phase = contains_pair(before, c) ? ContactPhase::persisting : ContactPhase::started;
  for (ContactState& c : ended) {
    if (contains_pair(contacts, c)) continue;
    c.phase = ContactPhase::ended;
    contacts.push_back(c);
  }
  ended.clear();
}

bool Simulation::Impl::busy() const {
  return fork || std::any_of(free_bodies.begin(), free_bodies.end(), [](const auto& b) { return b != nullptr; });
}

void Simulation::Impl::carry(SteppedBody& stepped, std::size_t object, double h) {
  ++report.steps;
  ContactOutcome outcome;
  if (with_contact) {
    contact_stepper->step(stepped, h, rows[object], outcome);
  } else {
    stepped.remember();
    if (!stepped.advance(h, Wrench())) {
      stepped.go_back();
      stepped.stay(h);
      ++report.guards_tripped;
    }
  }
  take_state(object, stepped.object());
  note_contacts(object, outcome, h);
}

void Simulation::Impl::step(double h) {
  if (fork) {
    const double added_before = fork->energy_added();
    fork->set_hand(track.segment(now), now);
    carry(*fork, held, h);
    report.energy_added += fork->energy_added() - added_before;
    const ForkBody::Estimates e = fork->take_estimates();
    report.position_error = std::max(report.position_error, e.position);
    report.angle_error = std::max(report.angle_error, e.angle);
    report.stiffest_omega_dt = std::max(report.stiffest_omega_dt, e.omega_dt);
  }
  for (std::size_t i = 0; i < objects.size(); ++i) {
    if (!free_bodies[i]) continue;
    carry(*free_bodies[i], i, h);
    BodyState& o = objects[i];
    o.asleep = false;
    const double speed = o.V_WO_W.linear.norm() + o.V_WO_W.angular.norm() * bounding_radius(body(i));
    const bool on_something_awake = std::any_of(touching[i].begin(), touching[i].end(), [&](const ContactState& c) {
      return std::any_of(objects.begin(), objects.end(),
                         [&](const BodyState& other) { return other.name == c.other && !other.asleep; });
    });
    if (!o.in_contact || on_something_awake || speed > asleep_speed) slow_since[i] = now + h;
    const bool away = o.X_WO.translation().norm() > world_limit;
    if (away || now + h - slow_since[i] > asleep_after) {
      free_bodies[i].reset();
      o.V_WO_W = Twist();
      o.asleep = true;
    }
  }
  now += h;
  if (!track.empty() && now >= track.begin() - same_time) X_WH = track.segment(now).at(now).X;
}

void Simulation::Impl::fill_parts() {
  const auto part = [&](const std::string& name, bool runs) {
    (runs ? report.parts_run : report.parts_left_out).push_back(name);
  };
  const bool dynamic_fork = fork && fork->held().size() > 0;
  part("stretch", dynamic_fork && settings.fork.dofs.stretch);
  part("bend", dynamic_fork && settings.fork.dofs.bend);
  part("torsion", dynamic_fork && settings.fork.dofs.torsion);
  part("gravity", scene.gravity > 0.0 && report.steps > 0);
  part("free_bodies", std::any_of(free_bodies.begin(), free_bodies.end(), [](const auto& b) { return b != nullptr; }));
  part("collision", with_contact && report.steps > 0);
  part("movable_neighbours", false);
}

void Simulation::Impl::advance(double t_end) {
  if (!started) {
    now = track.empty() ? t_end : std::min(track.begin(), t_end);
    started = true;
    if (!track.empty() && now >= track.begin() - same_time) X_WH = track.segment(now).at(now).X;
  }
  const double begin = now;
  std::vector<ContactState> before;
  for (const std::vector<ContactState>& of_object : touching) before.insert(before.end(), of_object.begin(), of_object.end());
  for (;;) {
    select();
    apply_buttons();
    if (now >= t_end - same_time) break;
    double end = std::min(t_end, now + settings.dynamics.step);
    if (!track.empty()) {
      const double next = now < track.begin() - same_time ? track.begin() : track.segment(now).end();
      if (next > now + same_time) end = std::min(end, next);
      // Equal steps up to the sample or the end rather than a last small one.
      const double stretch_end = std::min(t_end, next);
      const double count = std::ceil((stretch_end - now) / settings.dynamics.step - 1e-9);
      if (std::isfinite(count) && count >= 1.0) end = now + (stretch_end - now) / count;
      if (count <= 1.0) end = std::min(stretch_end, end);
    }
    if (!buttons.empty() && buttons.front().t > now + same_time) end = std::min(end, buttons.front().t);
    if (busy()) {
      step(end - now);
      now = end;
    } else {
      now = end;
      if (!track.empty() && now >= track.begin() - same_time) X_WH = track.segment(now).at(now).X;
    }
    if (!track.empty() && track.begin() < now) track.forget_before(now);
  }
  note_phases(before);
  report.simulated_time = now - begin;
}

Simulation::Simulation(const Scene& scene, const SimulationSettings& settings)
    : impl_(std::make_unique<Impl>(scene, settings)) {}
Simulation::~Simulation() = default;
Simulation::Simulation(Simulation&&) noexcept = default;
Simulation& Simulation::operator=(Simulation&&) noexcept = default;

const Scene& Simulation::scene() const { return impl_->scene; }
const SimulationSettings& Simulation::settings() const { return impl_->settings; }
double Simulation::time() const {
  return impl_->started || impl_->track.empty() ? impl_->now : impl_->track.begin();
}
bool Simulation::push_stylus(const PoseSample& sample) { return impl_->track.push(sample); }
void Simulation::push_button(double t, bool pressed) { impl_->buttons.push_back({t, pressed}); }
double Simulation::newest_sample() const { return impl_->track.empty() ? time() : impl_->track.end(); }

AdvanceReport Simulation::advance(double t_end) {
  impl_->report = AdvanceReport();
  impl_->advance(t_end);
  impl_->fill_parts();
  return impl_->report;
}

void Simulation::reset() {
  impl_->place_objects();
  impl_->track.clear();
  impl_->buttons.clear();
  impl_->hand = GraspSelection();
  impl_->grasped_by_name = false;
  impl_->started = false;
  impl_->X_WH = impl_->scene.X_WH_start;
}

bool Simulation::release() {
  if (!impl_->fork) return false;
  impl_->let_go(impl_->settings.grasp.release == "thrown");
  return true;
}

ChangeReport Simulation::set_dofs(const ForkDofs& dofs) {
  ChangeReport change;
  change.elastic_energy_before = impl_->elastic_energy();
  impl_->settings.fork.dofs = dofs;
  change.message = "families switched";
  if (impl_->fork && impl_->body(impl_->held).mass_properties.mass > 0.0) {
    ForkBody& fork = *impl_->fork;
    HeldBody& held = fork.held();
    const StrainState full = held.full_state(fork.time(), fork.state());
    fork.set_state(held.set_dofs(dofs, fork.time(), impl_->settings.fork.switch_off_time, full));
    if (held.returning()) {
      change.message += "; the strain of what went off returns to zero with a time constant of " +
                        std::to_string(impl_->settings.fork.switch_off_time) + " s and gives back its energy";
    }
  }
  change.elastic_energy_after = impl_->elastic_energy();
  return change;
}

ChangeReport Simulation::set_stiffness(const PerFamily& stiffness) {
  const NumberRule rule = not_negative();
  check_number("set_stiffness", "stretch", stiffness.stretch, rule);
  check_number("set_stiffness", "bend", stiffness.bend, rule);
  check_number("set_stiffness", "torsion", stiffness.torsion, rule);
  ChangeReport change;
  change.elastic_energy_before = impl_->elastic_energy();
  PerFamily& k = impl_->settings.fork.stiffness;
  if (stiffness.stretch > 0.0) k.stretch = stiffness.stretch;
  if (stiffness.bend > 0.0) k.bend = stiffness.bend;
  if (stiffness.torsion > 0.0) k.torsion = stiffness.torsion;
  if (impl_->fork) impl_->fork->held().set_springs(k, impl_->settings.fork.damping_ratio);
  change.elastic_energy_after = impl_->elastic_energy();
  change.message = "stiffness set; the strain stays as it is";
  return change;
}

ChangeReport Simulation::set_damping_ratio(const PerFamily& ratio) {
  const NumberRule rule = between(0.0, 10.0);
  check_number("set_damping", "stretch", ratio.stretch, rule);
  check_number("set_damping", "bend", ratio.bend, rule);
  check_number("set_damping", "torsion", ratio.torsion, rule);
  impl_->settings.fork.damping_ratio = ratio;
  if (impl_->fork) impl_->fork->held().set_springs(impl_->settings.fork.stiffness, ratio);
  const double energy = impl_->elastic_energy();
  return {energy, energy, "damping ratios set"};
}

ChangeReport Simulation::calibrate() {
  if (!impl_->fork) throw InputError("calibrate: held object: none is not allowed: must be an object that the fork holds");
  ChangeReport change;
  change.elastic_energy_before = impl_->elastic_energy();
  if (impl_->body(impl_->held).mass_properties.mass > 0.0) impl_->calibrate(impl_->fork->held());
  change.elastic_energy_after = impl_->elastic_energy();
  change.message = "calibrated for " + impl_->objects[impl_->held].name;
  return change;
}

void Simulation::set_integrator(const std::string& name, double step) {
  std::unique_ptr<Integrator> integrator = make_integrator(name);
  if (step != 0.0) check_number("set_integrator", "step", step, between(1e-6, 1.0));
  impl_->settings.dynamics.integrator = name;
  if (step != 0.0) impl_->settings.dynamics.step = step;
  if (impl_->fork) impl_->fork->set_integrator(std::move(integrator));
}

const std::vector<BodyState>& Simulation::objects() const { return impl_->objects; }
const std::vector<ContactState>& Simulation::contacts() const { return impl_->contacts; }

ToolState Simulation::fork() const {
  const SimulationSettings& s = impl_->settings;
  ToolState f;
  f.shape = s.fork.shape;
  f.integrator = s.dynamics.integrator;
  f.dofs = s.fork.dofs;
  f.length = s.fork.length;
  f.stiffness = s.fork.stiffness;
  f.damping_ratio = s.fork.damping_ratio;
  f.X_WH = f.X_WH_seen = impl_->X_WH;
  RigidTransform X_HE = RigidTransform::Identity();
  X_HE.translation().z() = s.fork.length;
  f.X_WE = impl_->X_WH * X_HE;
  if (!impl_->fork) return f;

  const ForkBody& fork = *impl_->fork;
  const HeldBody& held = fork.held();
  const StrainState full = held.full_state(fork.time(), fork.state());
  f.held_object = impl_->objects[impl_->held].name;
  f.X_WH_seen = fork.handle().X_WH;
  f.stretch = held.shape().extension(full.q);
  f.torsion = held.shape().twist(full.q);
  const RigidTransform X_HE_bent = held.shape().section(full.q, held.shape().length());
  f.bend = X_HE_bent.translation().head<2>();
  f.X_WE = f.X_WH_seen * X_HE_bent;
  const MotionState o = fork.object_with_acceleration();
  f.elastic_energy = held.elastic_energy(fork.time(), fork.state());
  if (!(impl_->body(impl_->held).mass_properties.mass > 0.0)) return f;
  f.kinetic_energy = held.kinetic_energy(o.velocity, o.X.linear());
  // What the rod does to the object: its change of momentum less gravity and contact.
  const Matrix3d I_W = o.X.linear() * held.body().inertia_O * o.X.linear().transpose();
  const Wrench& contact = held.external_wrench();
  const Vector3d force = held.body().mass * (o.acceleration.linear + impl_->scene.gravity * Vector3d::UnitZ()) - contact.force;
  const Vector3d moment = I_W * o.acceleration.angular + o.velocity.angular.cross(I_W * o.velocity.angular) - contact.moment;
  f.tip_wrench_W.force = force;
  f.tip_wrench_W.moment = moment + (o.X.translation() - f.X_WE.translation()).cross(force);
  const Vector3d at_handle = moment + (o.X.translation() - f.X_WH_seen.translation()).cross(force);
  const Matrix3d R_HW = f.X_WH_seen.linear().transpose();
  f.handle_wrench_H.force = -(R_HW * force);
  f.handle_wrench_H.moment = -(R_HW * at_handle);
  return f;
}

std::vector<RigidTransform> Simulation::centreline(int count) const {
  std::vector<RigidTransform> poses;
  const double L = impl_->settings.fork.length;
  for (int i = 0; i < count; ++i) {
    const double s = L * i / (count - 1);
    if (impl_->fork) {
      const HeldBody& held = impl_->fork->held();
      const StrainState full = held.full_state(impl_->fork->time(), impl_->fork->state());
      poses.push_back(impl_->fork->handle().X_WH * held.shape().section(full.q, s));
    } else {
      poses.push_back(impl_->X_WH * Eigen::Translation3d(0.0, 0.0, s));
    }
  }
  return poses;
}

}  // namespace spring_workbench
