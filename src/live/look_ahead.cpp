#include "spring_workbench/live/look_ahead.h"

#include <algorithm>

#include "constants.h"
#include "spring_workbench/math/so3.h"

namespace spring_workbench::live {

void LookAhead::show(const simulation::Simulation& committed, const hand_input::InputFilter& filter, double t) {
  copy_.copy_state_from(committed);
  has_followed_ = true;
  if (filter.has_sample()) {
    filter.predict(t, copy_);
    copy_.advance_to(t);
  }
  for (const Held& one : held_in_copy_.of(copy_)) shown_.push_back(one);
}

double LookAhead::show_newest(const simulation::Simulation& committed, const hand_input::InputFilter& filter,
                              double horizon, const Pace& pace) {
  const double newest = committed.newest_sample_time();
  if (up_to_date_ && horizon == 0.0) return std::max(copy_.time() - newest, 0.0);
  double t = committed.time();
  if (filter.has_sample()) {
    const double ahead = std::max(newest + horizon, shown_until_);
    if (pace.can_look_ahead(ahead - t)) t = std::max(ahead, t);
    if (t < shown_until_) return 0.0;
    shown_until_ = t;
  }
  show(committed, filter, t);
  up_to_date_ = horizon == 0.0;
  return std::max(t - newest, 0.0);
}

StepTime LookAhead::time_of_step(const simulation::Simulation& committed, const hand_input::InputFilter& filter,
                                 const Pace& pace) {
  const simulation::SimulationState shown = copy_.save();
  copy_.copy_state_from(committed);
  StepTime step{copy_.settings().dynamics.step / copy_.settings().hand_time_scale, 0.0};
  const double end = copy_.time() + 2.0 * step.lasts;
  filter.predict(end, copy_);
  copy_.advance_to(end - step.lasts);
  const double begin = pace.now();
  copy_.advance_to(end);
  step.takes = pace.now() - begin;
  copy_.restore(shown);
  return step;
}

PredictionError LookAhead::compare(const simulation::Simulation& committed) {
  up_to_date_ = false;
  const std::vector<Held> now = held_in_committed_.of(committed);
  PredictionError worst;
  while (!shown_.empty() && shown_.front().at.t <= committed.time()) {
    const Held shown = shown_.front();
    shown_.pop_front();
    const auto same = [&](const Held& other) { return other.object == shown.object; };
    const auto a = std::find_if(before_.begin(), before_.end(), same);
    const auto b = std::find_if(now.begin(), now.end(), same);
    if (a == before_.end() || b == now.end() || !(a->at.t <= shown.at.t) || !(a->at.t < b->at.t)) continue;
    const auto body_rate_state = [](const Held& h) { return Vector3d(h.at.X.linear().transpose() * h.V_WO_W.angular); };
    const motion::MotionSegment path(a->at, a->V_WO_W.linear, body_rate_state(*a), b->at, b->V_WO_W.linear,
                                     body_rate_state(*b));
    const RigidTransform X = path.at(shown.at.t).X;
    const double error = (X.translation() - shown.at.X.translation()).norm();
    worst.position = std::max(worst.position, error);
    worst.angle = std::max(worst.angle, math::turn_between(X, shown.at.X).norm());
    errors_.push_back(error);
    if (errors_.size() > max_errors) errors_.pop_front();
  }
  before_ = now;
  return worst;
}

double LookAhead::position_error_99() const {
  if (errors_.empty()) return 0.0;
  std::vector<double> sorted(errors_.begin(), errors_.end());
  const auto at = sorted.begin() + static_cast<std::ptrdiff_t>(error_quantile * static_cast<double>(sorted.size() - 1));
  std::nth_element(sorted.begin(), at, sorted.end());
  return *at;
}

void LookAhead::restart() {
  has_followed_ = up_to_date_ = false;
  shown_.clear();
  before_.clear();
}

std::vector<LookAhead::Held> LookAhead::HeldObjects::of(const simulation::Simulation& simulation) {
  const std::vector<bodies::BodyState>& objects = simulation.objects();
  const bodies::ChangeLog& changes = simulation.object_changes();
  if (at_.of != changes.now().of) held_.clear();
  for (const std::size_t i : changes.since(at_)) {
    held_.erase(i);
    if (objects[i].held) held_.insert(i);
  }
  at_ = changes.now();
  std::vector<Held> result;
  for (const std::size_t i : held_) result.push_back({i, {simulation.time(), objects[i].X_WO}, objects[i].V_WO_W});
  return result;
}

}  // namespace spring_workbench::live
