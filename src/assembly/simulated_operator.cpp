#include "spring_workbench/assembly/simulated_operator.h"

#include <algorithm>

#include "constants.h"
#include "spring_workbench/geometry/shape_queries.h"

namespace spring_workbench::assembly {
namespace {

/// Height of the fixed bodies of the scene above the bench [m].
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

SimulatedOperator::SimulatedOperator(const scene::Scene& scene, const OperatorSettings& settings, Observe look)
    : settings_(settings),
      observe_(std::move(look)),
      hands_(scene.X_WH_start, settings_),
      carry_height_(obstacle_height(scene) + clearance) {
  for (const auto& [name, target] : scene.targets)
    jobs_.emplace_back(scene.bodies[*scene::find_body(scene, name)], target);
  t_decide_ = settings_.reaction;
}

std::optional<motion::StylusSample> SimulatedOperator::next() {
  if (next_hand_ == 0) {
    if (phase_ == Phase::over && t_ >= t_decide_) return std::nullopt;
    begin_sample();
  }
  const std::size_t hand = next_hand_;
  next_hand_ = (hand + 1) % hands_.size();
  return hands_.sample(hand, t_);
}

void SimulatedOperator::begin_sample() {
  t_ = static_cast<double>(moments_++) / settings_.rate;
  percepts_.push_back({t_, observe_(), hands_.X_WH()});
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
      return move_tip_to(grasp_point(), Phase::insert);
    case Phase::insert:
      return insert();
    case Phase::grip:
      return grip();
    case Phase::lift:
      return move_object_to(carry_goal(), Phase::carry);
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

/// Chooses the next object that is not at its target, the one with the fewest attempts first; ends if there is none.
void SimulatedOperator::choose() {
  job_ = nullptr;
  engaged_.clear();
  for (OperatorJob& job : jobs_) {
    if (job.done(view().object(job.object()), view().turns()) || job.attempts >= max_attempts) continue;
    if (job_ == nullptr || job.attempts < job_->attempts) job_ = &job;
  }
  if (job_ == nullptr) {
    phase_ = Phase::over;
    t_decide_ = t_ + 1.0;  // observes the result
    return;
  }
  ++job_->attempts;
  corrections_ = 0;
  assign();
  choose_next_grasper();
}

/// Assigns the hands that grasp the object and the hand that receives it.
void SimulatedOperator::assign() {
  graspers_.clear();
  receiver_.reset();
  Numbers busy;
  for (const Vector3d& p_OG : job_->grips()) {
    graspers_.push_back({hands_.nearest(object().X_WO * p_OG, busy), p_OG});
    busy.push_back(graspers_.back().hand);
  }
  const std::size_t last = hands_.nearest(job_->p_WT(), {});
  if (graspers_.size() == 1 && last != busy.front()) receiver_ = last;
}

void SimulatedOperator::choose_next_grasper() {
  engaged_.push_back(graspers_.front().hand);
  move_tip_to(grasp_point() + carry_height_ * Vector3d::UnitZ(), Phase::above);
}

void SimulatedOperator::insert() {
  if (object().highlighted) {
    hands_.press(engaged_.back(), true);
    corrections_ = 0;
    return wait(settings_.reaction, Phase::grip);
  }
  if (++corrections_ > max_corrections) return let_go();
  move_tip_to(grasp_point(), Phase::insert);
}

void SimulatedOperator::grip() {
  if (!holds(engaged_.back())) {
    if (++corrections_ > max_corrections) return let_go();
    return wait(settings_.reaction, Phase::grip);
  }
  corrections_ = 0;
  graspers_.pop_front();
  if (!graspers_.empty()) return choose_next_grasper();
  if (receiver_ == engaged_.back()) {  // the receiver has the object: the other hand returns to its start
    receiver_.reset();
    hands_.press(engaged_.front(), false);
    hands_.reach(
        {engaged_.front()}, [this](std::size_t hand) { return hands_.X_WH_start(hand); }, t_);
    engaged_.erase(engaged_.begin());
    return move_object_to(carry_goal(), Phase::carry);
  }
  reach(
      engaged_, [this](std::size_t hand) { return hand_lifted(hand); }, Phase::lift, false);
}

void SimulatedOperator::carry() {
  if (job_->off(object(), carry_goal(), false) && ++corrections_ <= max_corrections) {
    return move_object_to(carry_goal(), Phase::carry);
  }
  corrections_ = 0;
  if (!receiver_) return move_object_to(job_->goal(object(), view().turns(), 0.0), Phase::lower);
  graspers_.push_back({*receiver_, job_->grips().front()});
  choose_next_grasper();
}

void SimulatedOperator::lower() {
  const RigidTransform goal = job_->goal(object(), view().turns(), 0.0);
  const bool off = job_->off(object(), goal, !object().in_contact);
  const bool steady = object().V_WO_W.linear.norm() < steady_speed;
  if ((off || !steady) && ++corrections_ <= max_corrections) {
    return off ? move_object_to(goal, Phase::lower) : wait(settings_.reaction, Phase::lower);
  }
  let_go();
}

void SimulatedOperator::let_go() {
  for (const std::size_t hand : engaged_) hands_.press(hand, false);
  wait(settings_.reaction, Phase::release);
}

Vector3d SimulatedOperator::grasp_point() const { return object().X_WO * graspers_.front().p_OG; }

RigidTransform SimulatedOperator::hand_lifted(std::size_t hand) const {
  RigidTransform X_WH = hands_.X_WH_goal(hand);
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

void SimulatedOperator::move_tip_to(const Vector3d& p_WE, Phase then) {
  const auto place = [&](std::size_t hand) {
    RigidTransform X_WH = hands_.X_WH_start(hand);
    X_WH.translation() = p_WE - X_WH.linear() * view().tools[hand].X_HE.translation();
    return X_WH;
  };
  reach({engaged_.back()}, place, then);
}

void SimulatedOperator::move_object_to(const RigidTransform& X_WO, Phase then) {
  const auto place = [&](std::size_t hand) {
    const RigidTransform X_WH = X_WO * object().X_WO.inverse() * percepts_.front().X_WH[hand];
    return make_transform(X_WH.translation(),
                          Quaterniond(X_WH.linear()));  // composed motions accumulate rounding errors
  };
  reach(engaged_, place, then);
}

void SimulatedOperator::reach(const Numbers& hands, const PoseOfHand& X_WH, Phase then, bool look) {
  t_decide_ = hands_.reach(hands, X_WH, t_) + (look ? settings_.reaction : 0.0);
  phase_ = then;
}

void SimulatedOperator::wait(double seconds, Phase then) {
  t_decide_ = t_ + std::max(seconds, 3.0 / settings_.rate);
  phase_ = then;
}

}  // namespace spring_workbench::assembly
