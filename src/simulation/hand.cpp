#include "hand.h"

#include <algorithm>
#include <limits>
#include <utility>

#include "spring_workbench/rod/shape_model.h"
#include "spring_workbench/scene/geometry.h"
#include "spring_workbench/tools/calibration.h"

namespace spring_workbench {
namespace {

constexpr double never = std::numeric_limits<double>::infinity();
constexpr double point_mass_radius = 1e-2;  ///< of the fork's length: radius of gyration of a point mass
constexpr double on_the_axis = 1e-3;        ///< of the fork's length; a point mass so near to the fork's axis cannot twist it

}  // namespace

Hand::Hand(const Scene& scene, SimulationSettings& settings, Workbench& workbench)
    : scene_(scene),
      settings_(settings),
      workbench_(workbench),
      track_(settings.dropout_after),
      X_WH_(scene.X_WH_start) {}

void Hand::reset() {
  track_.clear();
  buttons_.clear();
  X_WH_ = scene_.X_WH_start;
  selection_ = GraspSelection();
  grasped_by_name_ = false;
  hold_.reset();
}

double Hand::next_sample(double now) {
  if (track_.empty()) return never;
  return known(now) ? track_.segment(now).end() : track_.begin();
}

double Hand::next_button(double now) const {
  return !buttons_.empty() && buttons_.front().t > now + same_time ? buttons_.front().t : never;
}

void Hand::follow(double now) {
  if (known(now)) X_WH_ = track_.segment(now).at(now).X;
}

void Hand::forget_before(double now) {
  if (!track_.empty() && track_.begin() < now) track_.forget_before(now);
}

void Hand::select(double now) {
  selection_.set_inserted(std::nullopt);
  if (hold_ || !known(now)) return;
  const Vector3d tip = X_WH_ * Vector3d(0.0, 0.0, settings_.fork.length);
  const std::vector<BodyState>& objects = workbench_.states();
  double nearest = never;
  for (std::size_t i = 0; i < objects.size(); ++i) {
    const double distance = (objects[i].X_WO.translation() - tip).norm();
    if (!objects[i].held && distance < nearest && contains(workbench_.body(i), objects[i].X_WO.inverse() * tip)) {
      nearest = distance;
      selection_.set_inserted(i);
    }
  }
  if (selection_.inserted() && settings_.grasp.object.empty()) {
    workbench_.state(*selection_.inserted()).highlighted = true;
  }
}

void Hand::apply_buttons(double now) {
  if (!settings_.grasp.object.empty()) {
    if (!grasped_by_name_ && known(now)) {
      const std::optional<std::size_t> object = workbench_.find(settings_.grasp.object);
      if (object && !workbench_.states()[*object].held) {
        grasp(*object, settings_.grasp.X_OE, settings_.grasp.start_follow, now);
      }
      grasped_by_name_ = true;
    }
    return;
  }
  while (!buttons_.empty() && buttons_.front().t <= now + same_time) {
    const bool pressed = buttons_.front().pressed;
    buttons_.pop_front();
    switch (selection_.set_button(pressed, hold_ != nullptr)) {
      case GraspEvent::grasp: grasp(*selection_.inserted(), std::nullopt, false, now); break;
      case GraspEvent::release: let_go(settings_.grasp.release == "thrown", now); break;
      case GraspEvent::none: break;
    }
  }
}

ForkDofs Hand::possible_dofs(std::size_t object, const RigidTransform& X_OE) const {
  if (workbench_.massless(object)) return {false, false, false};
  ForkDofs dofs = settings_.fork.dofs;
  const Vector3d lever = X_OE.linear().col(2).cross(X_OE.translation());
  const bool point_mass = settings_.dynamics.inertia == "point_mass";
  if (point_mass && lever.norm() < on_the_axis * settings_.fork.length) dofs.torsion = false;
  return dofs;
}

StepControl Hand::make_step_control() const {
  return StepControl(make_integrator(settings_.dynamics.integrator), settings_.dynamics.tolerance);
}

HeldBody Hand::make_held(std::size_t object, const RigidTransform& X_OE, double now) {
  const Body& b = workbench_.body(object);
  BodyInertia inertia{b.mass_properties.mass, b.mass_properties.inertia_O, X_OE};
  if (settings_.dynamics.inertia == "point_mass") {
    // The paper's I = r² m: all of the mass at its centre. A small radius keeps the rotation about that point defined.
    const double radius = point_mass_radius * settings_.fork.length;
    inertia.inertia_O = inertia.mass * radius * radius * Matrix3d::Identity();
  }
  const bool massless = workbench_.massless(object);
  if (massless) {
    inertia.mass = 1.0;  // of no effect: nothing bends a fork that carries nothing
    inertia.inertia_O.setIdentity();
  }
  HeldBody held_body(make_shape_model(settings_.fork.shape, settings_.fork.length), inertia, scene_.gravity);
  if (settings_.grasp.calibrate && !massless) {
    calibrate(held_body);
  } else {
    held_body.set_springs(settings_.fork.stiffness, settings_.fork.damping_ratio);
  }
  const StrainState zero{StrainVector::Zero(held_body.shape().size()), StrainVector::Zero(held_body.shape().size())};
  held_body.set_dofs(possible_dofs(object, X_OE), now, settings_.fork.switch_off_time, zero);
  return held_body;
}

/// Springs for the object as it is grasped; in every direction the damping ratio that is set for the family.
void Hand::calibrate(HeldBody& held_body) {
  const ForkCalibration fork_for_it =
      calibrated_fork(settings_.fork.shape, settings_.fork.length, held_body.body(), scene_.gravity);
  const PerFamily& ratio = settings_.fork.damping_ratio;
  const PerFamily& c = fork_for_it.damping;
  settings_.fork.stiffness = fork_for_it.stiffness;
  held_body.set_springs_and_dampers(fork_for_it.stiffness, {ratio.stretch * c.stretch, ratio.bend * c.bend,
                                                            ratio.torsion * c.torsion});
}

void Hand::grasp(std::size_t object, const std::optional<RigidTransform>& X_OE, bool follow_hand, double now) {
  const MassProperties& mass = workbench_.body(object).mass_properties;
  if (settings_.grasp.calibrate && follow_hand && mass.mass > 0.0) {  // the object comes to the tip, wherever that is
    settings_.fork.length = calibrated_length({mass.mass, mass.inertia_O, RigidTransform::Identity()});
  }
  RigidTransform X_HE = RigidTransform::Identity();
  X_HE.translation().z() = settings_.fork.length;
  const MotionSegment& segment = track_.segment(now);
  const BodyState& o = workbench_.states()[object];
  const RigidTransform X_WE = segment.at(now).X * X_HE;
  const RigidTransform G = X_OE ? *X_OE : RigidTransform(o.X_WO.inverse() * X_WE);
  held_ = object;
  hold_ = std::make_unique<ForkBody>(workbench_.scene_index(object), make_held(object, G, now), make_step_control(), now);
  hold_->set_hand(segment, now);
  // Strain is zero now. The object keeps its motion as far as the fork lets it; one that follows starts with the hand's.
  if (!follow_hand && dynamic()) hold_->take_twist(o.V_WO_W);
  workbench_.hold(object, now);
  workbench_.take_state(object, hold_->object());
}

void Hand::let_go(bool thrown, double now) {
  if (!hold_) return;
  workbench_.let_go(held_, thrown, now);
  hold_.reset();
}

SteppedBody* Hand::begin_step(double now, double h) {
  if (!hold_) return nullptr;
  hold_->set_hand(track_.segment(now), now);
  energy_added_before_ = hold_->energy_added();
  BodyState& o = workbench_.state(held_);
  const bool was_asleep = o.asleep;
  o.asleep = hold_->sleeps(h, workbench_.rests(held_));
  if (o.asleep) {
    hold_->let_pass(h);
    o.V_WO_W = Twist();
    return nullptr;
  }
  if (was_asleep) workbench_.wake_what_lies_on(held_, now);
  moved_ = true;
  return hold_.get();
}

void Hand::end_step(AdvanceReport& report) {
  if (!hold_) return;
  report.energy_added += hold_->energy_added() - energy_added_before_;
  const ForkBody::Estimates e = hold_->take_estimates();
  report.position_error = std::max(report.position_error, e.position);
  report.angle_error = std::max(report.angle_error, e.angle);
  report.stiffest_omega_dt = std::max(report.stiffest_omega_dt, e.omega_dt);
  report.steps += e.extra_steps;
  report.steps_rejected += e.rejected;
  report.energy_held += e.energy_held;
}

ForkDofs Hand::families_run() const {
  return hold_ && moved_ ? possible_dofs(held_, hold_->held().body().X_OE) : ForkDofs{false, false, false};
}

void Hand::change_dofs(ChangeReport& change) {
  if (!hold_ || workbench_.massless(held_)) return;
  HeldBody& held = hold_->held();
  const StrainState full = held.full_state(hold_->time(), hold_->state());
  const ForkDofs possible = possible_dofs(held_, held.body().X_OE);
  hold_->set_state(held.set_dofs(possible, hold_->time(), settings_.fork.switch_off_time, full));
  if (held.returning()) {
    change.message += "; the strain of what went off returns to zero with a time constant of " +
                      std::to_string(settings_.fork.switch_off_time) + " s and gives back its energy";
  }
}

void Hand::change_springs() {
  if (hold_) hold_->held().set_springs(settings_.fork.stiffness, settings_.fork.damping_ratio);
}

void Hand::change_integrator() {
  if (hold_) hold_->set_step_control(make_step_control());
}

bool Hand::calibrate(ChangeReport& change) {
  if (!hold_) return false;
  if (!workbench_.massless(held_)) calibrate(hold_->held());
  change.message = "calibrated for " + workbench_.states()[held_].name;
  return true;
}

double Hand::elastic_energy() const { return hold_ ? hold_->held().elastic_energy(hold_->time(), hold_->state()) : 0.0; }

ToolState Hand::state() const {
  ToolState f;
  f.shape = settings_.fork.shape;
  f.integrator = settings_.dynamics.integrator;
  f.dofs = settings_.fork.dofs;
  f.length = settings_.fork.length;
  f.strain = StrainVector::Zero(make_shape_model(f.shape, f.length)->size());
  f.stiffness = settings_.fork.stiffness;
  f.damping_ratio = settings_.fork.damping_ratio;
  f.X_WH = f.X_WH_seen = X_WH_;
  RigidTransform X_HE = RigidTransform::Identity();
  X_HE.translation().z() = settings_.fork.length;
  f.X_WE = X_WH_ * X_HE;
  if (hold_) {
    f.held_object = workbench_.states()[held_].name;
    hold_->describe(workbench_.massless(held_), f);
  }
  return f;
}

}  // namespace spring_workbench
