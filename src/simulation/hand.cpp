#include "hand.h"

#include <algorithm>
#include <stdexcept>

#include "constants.h"
#include "spring_workbench/math/moving_frames.h"
#include "spring_workbench/tools/calibration.h"
#include "spring_workbench/validation/number_rule.h"

namespace spring_workbench::simulation {
Hand::Hand(const scene::Scene& scene, const SimulationSettings& settings, objects::Objects& objects, tools::Tool tool)
    : scene_(scene),
      settings_(settings),
      loads_(scene, settings.grasp.world_goal),
      around_(scene),
      fork_(settings.fork),
      objects_(objects),
      tool_(tool),
      stylus_(settings.hand_time_scale * settings.dropout_after,
              settings.hand_time_scale * settings.external_wrench_timeout, scene.X_WH_start.front()),
      ray_length_(longest_ray) {}

void Hand::reset() {
  stylus_.reset();
  inserted_.reset();
  pressed_ = grasped_by_name_ = pushes_ = false;
  hold_.reset();
  probe_.reset();
}

void Hand::continue_from(Hand& before, const std::string& new_mass, double now) {
  const std::string held = before.hold_ ? before.object().name : "";
  const bool had_mass = before.springs();
  const std::unique_ptr<tools::ToolHold> old = held == new_mass ? std::move(before.hold_) : nullptr;
  before.grasp_.object = objects_.find(held).value_or(0);
  math::StateArchive taken;
  before.archive(taken, now);
  math::StateArchive given(taken.words());
  archive(given, now);
  if (!old) return;
  const bool pulls = had_mass && !objects_.massless(grasp_.object);
  if (!pulls) grasp_ = grasp_of(grasp_.object);
  make_hold(now);
  if (pulls && dynamic()) hold_->regrasp(object().X_WO, old->spring_pull());
  keep_twist(object().V_WO_W);
  objects_.take_state(grasp_.object, hold_->object());
}

double Hand::reach() const {
  if (tool_ == tools::Tool::direct) return min_length;
  return tool_ == tools::Tool::ray ? std::max(ray_length_, min_length) : fork_.length;
}

void Hand::apply_buttons(double now) {
  if (!settings_.grasp.object.empty() && !grasped_by_name_ && stylus_.known(now)) {
    const std::optional<std::size_t> object = objects_.find(settings_.grasp.object);
    if (object && !objects_.states()[*object].held && tools::can_hold(tool_)) {
      grasp(*object, settings_.grasp.X_OE, settings_.grasp.start_follow, now);
    }
    grasped_by_name_ = true;
  }
  while (const auto edge = stylus_.take_edge(now)) {
    if (*edge == motion::ButtonEdge::next_tool) {
      select_tool(tools::next_tool(tool_, hold_ != nullptr), now);
    } else if (*edge == motion::ButtonEdge::clutch_on || *edge == motion::ButtonEdge::clutch_off) {
      set_clutch(*edge == motion::ButtonEdge::clutch_on, now);
    } else if (settings_.grasp.object.empty()) {
      apply_grasp_button(*edge == motion::ButtonEdge::grasp, now);
    }
  }
}

void Hand::apply_grasp_button(bool pressed, double now) {
  const bool rising = pressed && !pressed_;
  pressed_ = pressed;
  if (rising && !hold_ && inserted_) grasp(*inserted_, std::nullopt, false, now);
  if (!pressed) let_go(settings_.grasp.release == tools::Release::thrown, now);
}

tools::Grasp Hand::grasp_of(std::size_t object) const {
  const RigidTransform X_WE = stylus_.X_WS() * Eigen::Translation3d(0.0, 0.0, reach());
  return {tool_, object, stylus_.X_WS(), objects_.states()[object].X_WO.inverse() * X_WE, reach(), reach()};
}

void Hand::fit_size(tools::Grasp& grasp) const {
  if (tool_ != tools::Tool::spring_fork || to_world() || objects_.massless(grasp.object)) return;
  const scene::MassProperties& mass = objects_.body(grasp.object).mass_properties;
  grasp.length =
      tools::calibrated_length({mass.mass, mass.inertia_O, RigidTransform::Identity()}, settings_.grasp.object_goal);
}

void Hand::make_hold(double now) {
  slip_.close();
  hold_ = maker().make(grasp_, grasped_body(), now);
  hold_->set_hand(stylus_.provisional(now), now);
}

bool Hand::calibrate_hold() {
  if (!hold_ || tool_ == tools::Tool::direct || tool_ == tools::Tool::ray) return false;
  if (objects_.massless(grasp_.object)) return true;
  fork_.stiffness = to_world() ? settings_.fork.stiffness
                               : hold_->fitting_stiffness(fork_, scene_.gravity, settings_.grasp.object_goal);
  tools::damp_calibrated(fork_);
  hold_->set_springs(fork_);
  return true;
}

void Hand::grasp(std::size_t object, const std::optional<RigidTransform>& X_OE, bool follow_hand, double now) {
  grasp_ = grasp_of(object);
  if (X_OE) grasp_.X_OE = *X_OE;
  if (settings_.grasp.calibrate == tools::Calibration::object) fit_size(grasp_);
  make_hold(now);
  if (settings_.grasp.calibrate == tools::Calibration::object) calibrate_hold();
  // Strain is zero now. The object keeps its twist as far as the tool allows; with `start.follow` it takes the hand's.
  if (!follow_hand && dynamic()) hold_->take_twist(objects_.states()[object].V_WO_W);
  objects_.hold(object, objects::Objects::Grip::grasp, now);
  objects_.take_state(object, hold_->object());
}

void Hand::keep_twist(const Twist& V_WO_W) {
  if (objects_.massless(grasp_.object)) return;
  // With all DOFs on, a fork can take any twist; the DOFs that are off then return to zero strain smoothly.
  hold_->set_dofs({true, true, true}, fork_.switch_off_time);
  hold_->take_twist(V_WO_W);
  hold_->set_dofs(maker().possible_dofs(grasp_, grasped_body()), fork_.switch_off_time);
}

void Hand::select_tool(tools::Tool tool, double now) {
  if (tool == tool_) return;
  tool_ = tool;
  end_touch(now);
  if (!tools::can_hold(tool)) let_go(settings_.grasp.release == tools::Release::thrown, now);
  if (!hold_) return;
  const Twist before = object().V_WO_W;
  ray_length_ = std::max((stylus_.X_WS().inverse() * object().X_WO.translation()).z(), min_length);
  grasp_ = grasp_of(grasp_.object);
  if (settings_.grasp.calibrate == tools::Calibration::object) fit_size(grasp_);
  make_hold(now);
  if (settings_.grasp.calibrate == tools::Calibration::object) calibrate_hold();
  keep_twist(before);
  objects_.take_state(grasp_.object, hold_->object());
}

void Hand::take_over(const Wrench& pull_W, double now) {
  slip_.close();
  hold_->set_hand(stylus_.provisional(now), now);
  hold_->regrasp(object().X_WO, pull_W);
  hold_->take_twist(object().V_WO_W);
}

void Hand::let_go(bool thrown, double now) {
  if (!hold_) return;
  objects_.let_go(grasp_.object, objects::Objects::Grip::grasp, thrown, now);
  hold_.reset();
}

void Hand::set_clutch(bool on, double now) {
  stylus_.set_clutch(on, now);
  if (!hold_ || (on && object().asleep)) return;  // it stays asleep
  const Twist before = object().V_WO_W;
  const motion::MotionSegment at_rest(slip_.of(stylus_.X_WS()));
  hold_->set_hand(slip_.open() ? at_rest : stylus_.provisional(now), now);
  keep_twist(before);
}

tools::ToolOnObject Hand::begin_shared_step(double now, double h) {
  moved_ = true;
  objects_.state(grasp_.object).asleep = false;
  if (probe_) probe_->set_hand(stylus_.motion(now));
  if (hold_) hold_->set_hand(slip_.motion(stylus_.motion(now), now, h), now);
  if (hold_ && slip_.open()) hold_->take_twist(object().V_WO_W);
  if (hold_) energy_added_before_ = hold_->energy_added();
  return {hold_.get(), probe_.get()};
}

bodies::SteppedBody* Hand::begin_step(double now, double h, const Wrench& load_W) {
  const motion::MotionSegment before = hold_->hand();
  hold_->set_hand(slip_.motion(stylus_.motion(now), now, h), now);
  hold_->set_load(load_W);
  hold_->lead({});
  if (slip_.open()) hold_->take_twist(object().V_WO_W);
  energy_added_before_ = hold_->energy_added();
  bodies::BodyState& o = objects_.state(grasp_.object);
  const bool was_asleep = o.asleep, jumps = before.rests_apart_from(hold_->hand(), now);  // after a gap
  o.asleep = hold_->sleeps(h, !jumps && objects_.rests(grasp_.object));
  if (o.asleep) {
    hold_->advance_at_rest(h);
    o.V_WO_W = Twist();
    return nullptr;
  }
  if (was_asleep || jumps) objects_.wake_supported_by(grasp_.object, now);
  moved_ = true;
  return hold_.get();
}

void Hand::end_step(AdvanceReport& report) {
  if (!hold_) return;
  slip_.accept();
  report.energy_balance += hold_->energy_added() - energy_added_before_;
  add_to(report, hold_->take_estimates());
}

bodies::SteppedBody* Hand::begin_slip(const Wrench& load_W) {
  moved_ = true;
  energy_added_before_ = hold_->energy_added();
  objects_.state(grasp_.object).asleep = false;
  return (pulled_ = maker().make_pulled(grasp_, grasped_body(), object().V_WO_W, load_W)).get();
}

void Hand::change_fork(const ForkChange& change, std::string& message) {
  fork_ = change.applied_to(fork_);
  if (change.changes_springs() && hold_) hold_->set_springs(fork_);
  if (change.changes_springs() && probe_) probe_->set_springs(fork_);
  if (change.dofs.empty() || !hold_ || objects_.massless(grasp_.object) || tool_ != tools::Tool::spring_fork) return;
  if (hold_->set_dofs(maker().possible_dofs(grasp_, grasped_body()), fork_.switch_off_time)) {
    message += "; the strain of a DOF that was switched off returns to zero within about " +
               validation::number_text(7.0 * fork_.switch_off_time) + " s and releases its energy";
  }
}

void Hand::calibrate(std::string& message, double now) {
  if (!hold_) return;
  const bodies::BodyState before = object();
  const Wrench pull = hold_->spring_pull();
  if (tool_ == tools::Tool::spring_fork) {
    fit_size(grasp_);
    make_hold(now);
  }
  if (!calibrate_hold()) return;
  hold_->regrasp(before.X_WO, pull);
  keep_twist(before.V_WO_W);
  const std::string done = objects_.massless(grasp_.object) ? before.name + " has no mass: nothing to calibrate"
                           : to_world()                     ? "restored the scene's stiffness for " + before.name
                                                            : "calibrated for " + before.name;
  if (message.find(done) == std::string::npos) message += (message.empty() ? "" : "; ") + done;
}

tools::ToolState Hand::state(double now) const {
  const double length = hold_ ? hold_->length() : reach();
  tools::ToolState f = instruments::unloaded(tool_, fork_, settings_.dynamics.integrator, length, stylus_.X_WS());
  f.present = !stylus_.track().empty();
  if (hold_) {
    f.held_object = object().name;
    hold_->describe(objects_.massless(grasp_.object), f);
    if (slip_.open()) f.X_WH = stylus_.X_WS() * slip_.of(stylus_.X_WS()).inverse() * f.X_WH;
  }
  if (probe_) probe_->describe(stylus_.X_WS(), f);
  if (!hold_) f.V_WE_W = math::shifted(stylus_.twist(now), f.X_WE.translation() - stylus_.X_WS().translation());
  f.clutch = stylus_.clutched();
  loads_.read(f);
  return f;
}

void Hand::archive(math::StateArchive& state, double now) {
  bool holds = hold_ != nullptr, touches = probe_ != nullptr;
  std::size_t touched = scene_.bodies.size();  // default: the bench
  if (touches && probe_->body() != nullptr) touched = static_cast<std::size_t>(probe_->body() - scene_.bodies.data());
  state(fork_.dofs, fork_.stiffness, fork_.damping_ratio, fork_.damping_coefficient, fork_.damping_law);
  state(tool_, stylus_, ray_length_, inserted_, pressed_, grasped_by_name_, pushes_, grasp_, slip_, holds, touches,
        touched);
  if (state.is_restoring()) {
    if (grasp_.object >= std::max<std::size_t>(objects_.states().size(), 1))
      throw std::out_of_range("the tool holds an unknown object");
    hold_ = holds ? maker().make(grasp_, grasped_body(), now, hold_.get()) : nullptr;
    const scene::Body* body = touched < scene_.bodies.size() ? &scene_.bodies[touched] : nullptr;
    const tools::AxisHit front{0.0, body, body != nullptr ? &body->material : &scene_.bench_material};
    probe_ = touches ? std::make_unique<tools::Probe>(fork_.length, fork_, front, now) : nullptr;
  }
  if (holds) state(*hold_);
  if (touches) state(*probe_);
}

}  // namespace spring_workbench::simulation
