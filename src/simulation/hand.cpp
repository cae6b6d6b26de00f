#include "hand.h"

#include <algorithm>
#include <limits>
#include <utility>

#include "fork_body.h"
#include "spring_body.h"
#include "spring_workbench/rod/shape_model.h"
#include "spring_workbench/tools/calibration.h"

namespace spring_workbench {
namespace {

constexpr double never = std::numeric_limits<double>::infinity();
constexpr double least_length = 1e-4;  ///< [m] of a rigid tool
constexpr double point_mass_radius = 1e-2;  ///< of the fork's length: radius of gyration of a point mass
constexpr double on_the_axis = 1e-3;        ///< of the fork's length; a point mass so near to the fork's axis cannot twist it

}  // namespace

Hand::Hand(const Scene& scene, SimulationSettings& settings, Workbench& workbench, Tool tool)
    : scene_(scene),
      settings_(settings),
      workbench_(workbench),
      tool_(tool),
      track_(settings.dropout_after),
      X_WH_(scene.X_WH_start),
      ray_length_(longest_ray) {}

void Hand::reset() {
  track_.clear();
  buttons_.clear();
  X_WH_ = scene_.X_WH_start;
  selection_ = GraspSelection();
  grasped_by_name_ = false;
  hold_.reset();
  probe_.reset();
  pushes_ = false;
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

double Hand::reach() const {
  if (tool_ == Tool::direct) return least_length;
  return tool_ == Tool::ray ? std::max(ray_length_, least_length) : settings_.fork.length;
}

void Hand::apply_buttons(double now) {
  if (!settings_.grasp.object.empty() && !grasped_by_name_ && known(now)) {
    const std::optional<std::size_t> object = workbench_.find(settings_.grasp.object);
    if (object && !workbench_.states()[*object].held && can_hold(tool_)) {
      grasp(*object, settings_.grasp.X_OE, settings_.grasp.start_follow, now);
    }
    grasped_by_name_ = true;
  }
  while (!buttons_.empty() && buttons_.front().t <= now + same_time) {
    const Press press = buttons_.front().press;
    buttons_.pop_front();
    if (press == Press::next_tool) {
      select_tool(next_tool(tool_, hold_ != nullptr), now);
    } else if (settings_.grasp.object.empty()) {
      apply_grasp_button(press == Press::grasp, now);
    }
  }
}

void Hand::apply_grasp_button(bool pressed, double now) {
  switch (selection_.set_button(pressed, hold_ != nullptr)) {
    case GraspEvent::grasp: grasp(*selection_.inserted(), std::nullopt, false, now); break;
    case GraspEvent::release: let_go(settings_.grasp.release == "thrown", now); break;
    case GraspEvent::none: break;
  }
}

ForkDofs Hand::possible_dofs(std::size_t object, const RigidTransform& X_OE) const {
  if (workbench_.massless(object) || tool_ != Tool::spring_fork) return {false, false, false};
  ForkDofs dofs = settings_.fork.dofs;
  const Vector3d lever = X_OE.linear().col(2).cross(X_OE.translation());
  const bool point_mass = settings_.dynamics.inertia == "point_mass";
  if (point_mass && lever.norm() < on_the_axis * settings_.fork.length) dofs.torsion = false;
  return dofs;
}

std::unique_ptr<ToolHold> Hand::make_fork(std::size_t object, const RigidTransform& X_OE, double length, double now) {
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
  HeldBody held_body(make_shape_model(settings_.fork.shape, length), inertia, scene_.gravity);
  held_body.set_springs(settings_.fork);
  const StrainState zero{StrainVector::Zero(held_body.shape().size()), StrainVector::Zero(held_body.shape().size())};
  X_OE_ = X_OE;
  held_body.set_dofs(possible_dofs(object, X_OE), now, settings_.fork.switch_off_time, zero);
  return std::make_unique<ForkBody>(workbench_.scene_index(object), std::move(held_body),
                                    ForkBody::make_step_control(settings_.dynamics), now);
}

std::unique_ptr<ToolHold> Hand::make_hold(std::size_t object, const RigidTransform& X_OE, double length, double now) {
  const RigidTransform& X_WO = workbench_.states()[object].X_WO;
  std::unique_ptr<ToolHold> hold;
  if (tool_ == Tool::spring && !workbench_.massless(object)) {
    const double rest_length = std::max((X_WO.translation() - X_WH_.translation()).norm(), least_length);
    hold = std::make_unique<SpringBody>(workbench_.scene_index(object), workbench_.body(object), scene_.gravity, X_WO,
                                        rest_length, settings_.fork);
  } else {
    hold = make_fork(object, X_OE, length, now);
  }
  hold->set_hand(track_.segment(now), now);
  return hold;
}

RigidTransform Hand::tip_in_object(std::size_t object, double length) const {
  return workbench_.states()[object].X_WO.inverse() * (X_WH_ * Eigen::Translation3d(0.0, 0.0, length));
}

bool Hand::calibrate_hold() {
  if (!hold_ || tool_ == Tool::direct || tool_ == Tool::ray) return false;
  if (!workbench_.massless(held_)) settings_.fork.stiffness = hold_->calibrate(settings_.fork, scene_.gravity);
  return true;
}

void Hand::grasp(std::size_t object, const std::optional<RigidTransform>& X_OE, bool follow_hand, double now) {
  const MassProperties& mass = workbench_.body(object).mass_properties;
  if (settings_.grasp.calibrate && follow_hand && mass.mass > 0.0) {  // the object comes to the tip, wherever that is
    settings_.fork.length = calibrated_length({mass.mass, mass.inertia_O, RigidTransform::Identity()});
  }
  held_ = object;
  hold_ = make_hold(object, X_OE ? *X_OE : tip_in_object(object, reach()), reach(), now);
  if (settings_.grasp.calibrate) calibrate_hold();
  // Strain is zero now. The object keeps its motion as far as the tool lets it; one that follows starts with the hand's.
  if (!follow_hand && dynamic()) hold_->take_twist(workbench_.states()[object].V_WO_W);
  workbench_.hold(object, Workbench::Grip::grasp, now);
  workbench_.take_state(object, hold_->object());
}

void Hand::select_tool(Tool tool, double now) {
  if (tool == tool_) return;
  tool_ = tool;
  leave_with_probe(now);
  if (!can_hold(tool)) let_go(true, now);
  if (!hold_) return;
  const Vector3d centre_H = X_WH_.inverse() * workbench_.states()[held_].X_WO.translation();
  ray_length_ = std::max(centre_H.z(), least_length);
  const Twist before = workbench_.states()[held_].V_WO_W;
  hold_ = make_hold(held_, tip_in_object(held_, reach()), reach(), now);
  if (settings_.grasp.calibrate) calibrate_hold();
  if (!workbench_.massless(held_)) {
    // With every family on, a fork can take any twist; what is off then comes to rest without a jump.
    hold_->set_dofs({true, true, true}, settings_.fork.switch_off_time);
    hold_->take_twist(before);
    hold_->set_dofs(possible_dofs(held_, X_OE_), settings_.fork.switch_off_time);
  }
  workbench_.take_state(held_, hold_->object());
}

void Hand::let_go(bool thrown, double now) {
  if (!hold_) return;
  workbench_.let_go(held_, Workbench::Grip::grasp, thrown, now);
  hold_.reset();
}

std::optional<std::size_t> Hand::carried() const {
  return hold_ || pushes_ ? std::optional<std::size_t>(held_) : std::nullopt;
}

CoupledTool* Hand::begin_shared_step(double now) {
  moved_ = true;
  workbench_.state(held_).asleep = false;
  if (probe_) {
    probe_->set_hand(track_.segment(now), now);
    return probe_.get();
  }
  hold_->set_hand(track_.segment(now), now);
  return hold_.get();
}

SteppedBody* Hand::begin_step(double now, double h) {
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
  const StepEstimates e = hold_->take_estimates();
  report.position_error = std::max(report.position_error, e.position);
  report.angle_error = std::max(report.angle_error, e.angle);
  report.stiffest_omega_dt = std::max(report.stiffest_omega_dt, e.omega_dt);
  report.steps += e.extra_steps;
  report.steps_rejected += e.rejected;
  report.energy_held += e.energy_held;
}

ForkDofs Hand::families_run() const {
  return hold_ && moved_ ? possible_dofs(held_, X_OE_) : ForkDofs{false, false, false};
}

void Hand::change_dofs(ChangeReport& change) {
  if (!hold_ || workbench_.massless(held_) || tool_ != Tool::spring_fork) return;
  if (hold_->set_dofs(possible_dofs(held_, X_OE_), settings_.fork.switch_off_time)) {
    change.message += "; the strain of what went off returns to zero with a time constant of " +
                      std::to_string(settings_.fork.switch_off_time) + " s and gives back its energy";
  }
}

void Hand::change_springs() {
  if (hold_) hold_->set_springs(settings_.fork);
  if (probe_) probe_->set_springs(settings_.fork);
}

void Hand::change_integrator() {
  if (hold_) hold_->set_step_control(settings_.dynamics);
}

bool Hand::calibrate(ChangeReport& change) {
  if (!calibrate_hold()) return false;
  change.message = "calibrated for " + workbench_.states()[held_].name;
  return true;
}

double Hand::elastic_energy() const {
  if (probe_) return probe_->elastic_energy();
  return hold_ ? hold_->elastic_energy() : 0.0;
}

ToolState Hand::state() const {
  ToolState f;
  f.present = !track_.empty();
  f.tool = name_of(tool_);
  f.shape = settings_.fork.shape;
  f.integrator = settings_.dynamics.integrator;
  f.dofs = settings_.fork.dofs;
  f.length = hold_ ? hold_->length() : reach();
  f.strain = StrainVector::Zero(make_shape_model(f.shape, f.length)->size());
  f.stiffness = settings_.fork.stiffness;
  f.damping_ratio = settings_.fork.damping_ratio;
  f.X_WH = f.X_WH_seen = X_WH_;
  RigidTransform X_HE = RigidTransform::Identity();
  X_HE.translation().z() = f.length;
  f.X_WE = X_WH_ * X_HE;
  if (hold_) {
    f.held_object = workbench_.states()[held_].name;
    hold_->describe(workbench_.massless(held_), f);
  }
  if (probe_) probe_->describe(X_WH_, f);
  f.force_scale = scene_.force_scale;
  f.weight = f.tip_wrench_W.force.z() / weighing_gravity(scene_.gravity);
  f.torque = f.tip_wrench_W.moment.dot(f.X_WE.linear().col(2));
  return f;
}

}  // namespace spring_workbench
