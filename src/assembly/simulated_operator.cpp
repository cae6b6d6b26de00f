#include "spring_workbench/assembly/simulated_operator.h"

#include <algorithm>

#include "constants.h"
#include "spring_workbench/geometry/shape_queries.h"

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

}  // namespace

SimulatedOperator::SimulatedOperator(const scene::Scene& scene, const OperatorSettings& settings, Look look)
    : settings_(settings),
      look_(std::move(look)),
      hands_(scene.X_WH_start, settings_),
      carry_height_(obstacle_height(scene) + clearance) {
  for (const auto& [name, target] : scene.targets)
    jobs_.emplace_back(scene.bodies[*scene::find_body(scene, name)], target);
  t_decide_ = settings_.reaction;
}

std::optional<motion::StylusSample> SimulatedOperator::next() {
  if (next_hand_ == 0) {
    if (phase_ == Phase::over && t_ >= t_decide_) return std::nullopt;
    begin_moment();
  }
  const std::size_t hand = next_hand_;
  next_hand_ = (hand + 1) % hands_.size();
  return hands_.sample(hand, t_);
}

void SimulatedOperator::begin_moment() {
  t_ = static_cast<double>(moments_++) / settings_.rate;
  percepts_.push_back({t_, look_(), hands_.X_WH()});
  while (percepts_.size() > 1 && percepts_[1].t <= t_ - settings_.reaction + time_slack) percepts_.pop_front();
  if (t_ >= t_decide_ - time_slack && phase_ != Phase::over) decide();
}

void SimulatedOperator::decide() {
  const auto lost = [this](std::size_t hand) { return hands_.pressed(hand) && !holds(hand); };
  if (phase_ != Phase::grip && std::any_of(engaged_.begin(), engaged_.end(), lost)) return let_go();
  switch (phase_) {
    case Phase::choose:
      return choose();
    case Phase::above:
      return take_to(grip_point(), Phase::insert);
    case Phase::insert:
      return insert();
    case Phase::grip:
      return grip();
    case Phase::lift:
      return bring_to(carry_goal(), Phase::carry);
    case Phase::carry:
      return carry();
    case Phase::lower:
      return lower();
    case Phase::release:
      return reach(
          engaged_, [this](std::size_t hand) { return hand_lifted(hand); }, Phase::choose, false);
    case Phase::over:
      return;
  }
}

/// The next object that is not where it belongs, the least tried one first; none: over.
void SimulatedOperator::choose() {
  job_ = nullptr;
  engaged_.clear();
  for (OperatorJob& job : jobs_) {
    if (job.done(view().object(job.object()), view().turns()) || job.attempts >= most_attempts) continue;
    if (job_ == nullptr || job.attempts < job_->attempts) job_ = &job;
  }
  if (job_ == nullptr) {
    phase_ = Phase::over;
    t_decide_ = t_ + 1.0;  // watches what it has done
    return;
  }
  ++job_->attempts;
  corrections_ = 0;
  assign();
  take_next();
}

/// Which hands take the object, and which one gets it from them.
void SimulatedOperator::assign() {
  takers_.clear();
  receiver_.reset();
  Numbers busy;
  for (const Vector3d& p_OG : job_->grips()) {
    takers_.push_back({hands_.nearest(object().X_WO * p_OG, busy), p_OG});
    busy.push_back(takers_.back().hand);
  }
  const std::size_t last = hands_.nearest(job_->p_WT(), {});
  if (takers_.size() == 1 && last != busy.front()) receiver_ = last;
}

void SimulatedOperator::take_next() {
  engaged_.push_back(takers_.front().hand);
  take_to(grip_point() + carry_height_ * Vector3d::UnitZ(), Phase::above);
}

void SimulatedOperator::insert() {
  if (object().highlighted) {
    hands_.press(engaged_.back(), true);
    corrections_ = 0;
    return wait(settings_.reaction, Phase::grip);
  }
  if (++corrections_ > most_corrections) return let_go();
  take_to(grip_point(), Phase::insert);
}

void SimulatedOperator::grip() {
  if (!holds(engaged_.back())) {
    if (++corrections_ > most_corrections) return let_go();
    return wait(settings_.reaction, Phase::grip);
  }
  corrections_ = 0;
  takers_.pop_front();
  if (!takers_.empty()) return take_next();
  if (receiver_ == engaged_.back()) {  // it has the object now, and the other hand goes home
    receiver_.reset();
    hands_.press(engaged_.front(), false);
    hands_.reach(
        {engaged_.front()}, [this](std::size_t hand) { return hands_.X_WH_start(hand); }, t_);
    engaged_.erase(engaged_.begin());
    return bring_to(carry_goal(), Phase::carry);
  }
  reach(
      engaged_, [this](std::size_t hand) { return hand_lifted(hand); }, Phase::lift, false);
}

void SimulatedOperator::carry() {
  if (job_->off(object(), carry_goal(), false) && ++corrections_ <= most_corrections) {
    return bring_to(carry_goal(), Phase::carry);
  }
  corrections_ = 0;
  if (!receiver_) return bring_to(job_->goal(object(), view().turns(), 0.0), Phase::lower);
  takers_.push_back({*receiver_, job_->grips().front()});
  take_next();
}

void SimulatedOperator::lower() {
  const RigidTransform goal = job_->goal(object(), view().turns(), 0.0);
  const bool off = job_->off(object(), goal, !object().in_contact);
  const bool steady = object().V_WO_W.linear.norm() < steady_speed;
  if ((off || !steady) && ++corrections_ <= most_corrections) {
    return off ? bring_to(goal, Phase::lower) : wait(settings_.reaction, Phase::lower);
  }
  let_go();
}

void SimulatedOperator::let_go() {
  for (const std::size_t hand : engaged_) hands_.press(hand, false);
  wait(settings_.reaction, Phase::release);
}

Vector3d SimulatedOperator::grip_point() const { return object().X_WO * takers_.front().p_OG; }

RigidTransform SimulatedOperator::hand_lifted(std::size_t hand) const {
  RigidTransform X_WH = hands_.X_WH_to(hand);
  X_WH.translation().z() += carry_height_;
  return X_WH;
}

RigidTransform SimulatedOperator::carry_goal() const {
  RigidTransform X_WO = job_->goal(object(), view().turns(), carry_height_);
  if (!receiver_) return X_WO;
  const auto start = [this](std::size_t hand) { return hands_.X_WH_start(hand).translation(); };
  X_WO.translation().head<2>() = 0.5 * (start(engaged_.front()) + start(*receiver_)).head<2>();
  return X_WO;
}

void SimulatedOperator::take_to(const Vector3d& p_WE, Phase then) {
  const auto place = [&](std::size_t hand) {
    RigidTransform X_WH = hands_.X_WH_start(hand);
    X_WH.translation() = p_WE - X_WH.linear() * view().tools[hand].X_HE.translation();
    return X_WH;
  };
  reach({engaged_.back()}, place, then);
}

void SimulatedOperator::bring_to(const RigidTransform& X_WO, Phase then) {
  const auto place = [&](std::size_t hand) {
    const RigidTransform X_WH = X_WO * object().X_WO.inverse() * percepts_.front().X_WH[hand];
    return make_transform(Quaterniond(X_WH.linear()), X_WH.translation());  // one motion after the other rounds
  };
  reach(engaged_, place, then);
}

void SimulatedOperator::reach(const Numbers& hands, const Place& X_WH, Phase then, bool look) {
  t_decide_ = hands_.reach(hands, X_WH, t_) + (look ? settings_.reaction : 0.0);
  phase_ = then;
}

void SimulatedOperator::wait(double seconds, Phase then) {
  t_decide_ = t_ + std::max(seconds, 3.0 / settings_.rate);
  phase_ = then;
}

}  // namespace spring_workbench::assembly
