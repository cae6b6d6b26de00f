#include "spring_workbench/assembly/simulated_operator.h"

#include <algorithm>
#include <cmath>

#include "constants.h"
#include "spring_workbench/assembly/placement.h"
#include "spring_workbench/geometry/shape_queries.h"
#include "spring_workbench/math/so3.h"
#include "spring_workbench/motion/minimum_jerk.h"
#include "spring_workbench/validation/number_rule.h"

namespace spring_workbench::assembly {
namespace {

/// Top of what stands fixed in the scene, above the bench.
double obstacle_height(const scene::Scene& scene) {
  double top = 0.0;
  for (const scene::Body& body : scene.bodies) {
    if (body.movable) continue;
    for (const geometry::Shape& shape : body.collision) {
      const double z = geometry::bounding_box(shape.geometry, body.X_WO * shape.X_OS).max().z();
      if (z < scene.bench_height + 1.0) top = std::max(top, z - scene.bench_height);
    }
  }
  return top;
}

void check(const OperatorSettings& s) {
  const std::string where = "operator";
  validation::check_number(where, "rate", s.rate, validation::between(1.0, 1000.0));
  validation::check_number(where, "reaction", s.reaction, validation::between(0.0, 2.0));
  validation::check_number(where, "position_noise", s.position_noise, validation::between(0.0, 0.1));
  validation::check_number(where, "angle_noise", s.angle_noise, validation::between(0.0, 1.0));
  validation::check_number(where, "aim_scatter", s.aim_scatter, validation::between(0.0, 0.5));
}

}  // namespace

SimulatedOperator::SimulatedOperator(const scene::Scene& scene, const OperatorSettings& settings, Look look)
    : settings_(settings),
      look_(std::move(look)),
      carry_height_(obstacle_height(scene) + clearance),
      R_WH_(scene.X_WH_start.linear()),
      random_(settings.seed),
      X_WH_(scene.X_WH_start),
      X_WH_from_(scene.X_WH_start),
      X_WH_to_(scene.X_WH_start) {
  check(settings_);
  for (const auto& [name, target] : scene.targets)
    jobs_.push_back({name, scene.bodies[*scene::find_body(scene, name)], target});
  t_decide_ = settings_.reaction;
}

std::optional<motion::StylusSample> SimulatedOperator::next() {
  if (phase_ == Phase::over && t_ >= t_decide_) return std::nullopt;
  t_ = static_cast<double>(samples_++) / settings_.rate;
  seen_.push_back({t_, look_(), X_WH_});
  while (seen_.size() > 1 && seen_[1].t <= t_ - settings_.reaction + time_slack) seen_.pop_front();
  if (t_ >= t_decide_ - time_slack && phase_ != Phase::over) decide();
  const double u = t_to_ > t_from_ ? std::clamp((t_ - t_from_) / (t_to_ - t_from_), 0.0, 1.0) : 1.0;
  X_WH_ = motion::minimum_jerk_pose(X_WH_from_, X_WH_to_, u);
  motion::StylusSample sample;
  sample.t = t_;
  sample.button = button_;
  const Vector3d p = X_WH_.translation() + settings_.position_noise * random_.next_vector();
  sample.X =
      make_transform(Quaterniond(X_WH_.linear() * math::exp_so3(settings_.angle_noise * random_.next_vector())), p);
  return sample;
}

void SimulatedOperator::decide() {
  const bool lost = button_ && phase_ != Phase::grip && !state_of(job_->object).held;
  if (lost) return let_go();
  switch (phase_) {
    case Phase::choose:
      return choose();
    case Phase::above:
      return reach(hand_over(state_of(job_->object).X_WO.translation()), Phase::insert);
    case Phase::insert:
      return insert();
    case Phase::grip:
      return grip();
    case Phase::lift:
      return reach(hand_for(goal(carry_height_)), Phase::carry);
    case Phase::carry:
      return carry();
    case Phase::lower:
      return lower();
    case Phase::release:
      return reach(hand_lifted(), Phase::choose, false);
    case Phase::over:
      return;
  }
}

/// The next object that is not where it belongs, the least tried one first; none: over.
void SimulatedOperator::choose() {
  job_ = nullptr;
  for (Job& job : jobs_) {
    if (done(job) || job.attempts >= most_attempts) continue;
    if (job_ == nullptr || job.attempts < job_->attempts) job_ = &job;
  }
  if (job_ == nullptr) {
    phase_ = Phase::over;
    t_decide_ = t_ + 1.0;  // watches what it has done
    return;
  }
  ++job_->attempts;
  corrections_ = 0;
  reach(hand_over(state_of(job_->object).X_WO.translation() + carry_height_ * Vector3d::UnitZ()), Phase::above);
}

bool SimulatedOperator::done(const Job& job) const {
  const bodies::BodyState& o = state_of(job.object);
  const Placement placement = judge_placement(job.body, job.target, o.X_WO, o.held);
  const bool as_near_as_can_be = !can_turn(job.target) && placement.position_error <= job.target.position_tolerance;
  return placement.in_place || (as_near_as_can_be && !o.held);
}

bool SimulatedOperator::can_turn(const scene::Target& target) const {
  return angle_matters(target) && seen_.front().view.turns;
}

void SimulatedOperator::insert() {
  const bodies::BodyState& o = state_of(job_->object);
  if (o.highlighted) {
    button_ = true;
    corrections_ = 0;
    return wait(settings_.reaction, Phase::grip);
  }
  if (++corrections_ > most_corrections) return let_go();
  reach(hand_over(o.X_WO.translation()), Phase::insert);
}

void SimulatedOperator::grip() {
  if (!state_of(job_->object).held) {
    if (++corrections_ > most_corrections) return let_go();
    return wait(settings_.reaction, Phase::grip);
  }
  corrections_ = 0;
  reach(hand_lifted(), Phase::lift, false);
}

void SimulatedOperator::carry() {
  const RigidTransform over_target = goal(carry_height_);
  if (off(over_target, false) && ++corrections_ <= most_corrections) {
    return reach(hand_for(over_target), Phase::carry);
  }
  corrections_ = 0;
  reach(hand_for(goal(0.0)), Phase::lower);
}

void SimulatedOperator::lower() {
  const bodies::BodyState& o = state_of(job_->object);
  const bool steady = o.V_WO_W.linear.norm() < steady_speed;
  if ((off(goal(0.0), !o.in_contact) || !steady) && ++corrections_ <= most_corrections) {
    return off(goal(0.0), !o.in_contact) ? reach(hand_for(goal(0.0)), Phase::lower)
                                         : wait(settings_.reaction, Phase::lower);
  }
  let_go();
}

void SimulatedOperator::let_go() {
  button_ = false;
  wait(settings_.reaction, Phase::release);
}

const bodies::BodyState& SimulatedOperator::state_of(const std::string& object) const {
  const std::vector<bodies::BodyState>& objects = seen_.front().view.objects;
  const auto o =
      std::find_if(objects.begin(), objects.end(), [&](const bodies::BodyState& s) { return s.name == object; });
  if (o == objects.end()) validation::refuse("operator", "object", object, "an object of the scene");
  return *o;
}

RigidTransform SimulatedOperator::hand_for(const RigidTransform& X_WO) const {
  const RigidTransform X_WH = X_WO * state_of(job_->object).X_WO.inverse() * seen_.front().X_WH;
  return make_transform(Quaterniond(X_WH.linear()), X_WH.translation());  // one motion after the other rounds
}

RigidTransform SimulatedOperator::hand_lifted() const {
  RigidTransform X_WH = X_WH_to_;
  X_WH.translation().z() += carry_height_;
  return X_WH;
}

RigidTransform SimulatedOperator::hand_over(const Vector3d& p_WE) const {
  RigidTransform X_WH = RigidTransform::Identity();
  X_WH.linear() = R_WH_;
  X_WH.translation() = p_WE - R_WH_ * seen_.front().view.X_HE.translation();
  return X_WH;
}

RigidTransform SimulatedOperator::goal(double lift) const {
  RigidTransform X_WO = job_->target.X_WL * job_->body.X_OL.inverse();
  if (!can_turn(job_->target)) X_WO.linear() = state_of(job_->object).X_WO.linear();
  X_WO.translation().z() += lift;
  return X_WO;
}

bool SimulatedOperator::off(const RigidTransform& X_WO_goal, bool height_too) const {
  const RigidTransform& X_WO = state_of(job_->object).X_WO;
  const Vector3d d = X_WO_goal.translation() - X_WO.translation();
  const double angle = math::log_so3(X_WO_goal.linear().transpose() * X_WO.linear()).norm();
  return d.head<2>().norm() > good_enough * job_->target.position_tolerance ||
         angle > good_enough * job_->target.angle_tolerance || (height_too && d.z() < -touching);
}

void SimulatedOperator::reach(const RigidTransform& X_WH, Phase then, bool look) {
  const Vector3d way = X_WH.translation() - X_WH_to_.translation();
  const double turn = math::log_so3(X_WH_to_.linear().transpose() * X_WH.linear()).norm();
  const double distance = std::hypot(way.norm(), lever * turn);
  X_WH_from_ = X_WH_to_;
  X_WH_to_ = X_WH;
  X_WH_to_.translation() += settings_.aim_scatter * way.norm() * random_.next_vector();
  t_from_ = t_;
  t_to_ = t_ + 0.1 + fitts_slope * std::log2(1.0 + distance / fitts_width);
  t_decide_ = t_to_ + (look ? settings_.reaction : 0.0);
  phase_ = then;
}

void SimulatedOperator::wait(double seconds, Phase then) {
  t_decide_ = t_ + std::max(seconds, 3.0 / settings_.rate);
  phase_ = then;
}

}  // namespace spring_workbench::assembly
