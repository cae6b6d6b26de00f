#include "spring_workbench/hand_input/reacquisition.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "constants.h"
#include "spring_workbench/math/so3.h"

namespace spring_workbench::hand_input {
namespace {

/// Smooth step from 0 to 1 for u = 0 … 1, with zero slope at both ends.
double smooth_step(double u) { return u >= 1.0 ? 1.0 : u * u * (3.0 - 2.0 * u); }

/// Fraction of a path of this length that is covered in `dt` [s].
double share(double path, double speed, double dt) {
  return path > 0.0 ? std::min(1.0, dt * std::min(speed / path, 1.0 / tail_time)) : 0.0;
}

}  // namespace

std::vector<motion::PoseSample> Reacquisition::follow(const motion::PoseSample& sample, bool relocation,
                                                      double simulated_until) {
  if (newest_ && sample.t <= simulated_until + same_time) {
    ++counts_.late;
    return {};
  }
  std::vector<motion::PoseSample> result;
  if (newest_) {
    if (sample.t > lost_at()) note_loss(lost_at());
    const bool held = simulated_until > newest_->t + same_time;
    if (held) result.push_back({simulated_until, newest_->X});
    if (held || relocation) begin_catch_up(sample);
  }
  result.push_back({sample.t, catching_up_ ? catch_up(sample) : sample.X});
  newest_ = result.back();
  tracked_ = sample;
  loss_noted_ = false;
  return result;
}

void Reacquisition::begin_catch_up(const motion::PoseSample& sample) {
  catching_up_ = true;
  catch_up_began_ = sample.t;
  tracked_ = sample;
  ++counts_.reacquisitions;
}

RigidTransform Reacquisition::catch_up(const motion::PoseSample& sample) {
  const double dt = sample.t - tracked_.t;
  const double ramp = smooth_step((sample.t - catch_up_began_) / ramp_time);
  RigidTransform X = newest_->X;  // first the step of the tracked hand ...
  X.translation() += ramp * (sample.X.translation() - tracked_.X.translation());
  X.linear() = X.linear() * math::exp_so3(ramp * math::log_so3(tracked_.X.linear().transpose() * sample.X.linear()));
  const Vector3d path = sample.X.translation() - X.translation();  // ... then the approach to it
  const Vector3d turn = math::log_so3(X.linear().transpose() * sample.X.linear());
  if (path.norm() < near && turn.norm() < near_angle) {
    catching_up_ = false;
    return sample.X;
  }
  X.translation() += ramp * share(path.norm(), settings_.reacquisition_speed, dt) * path;
  const Matrix3d R =
      X.linear() * math::exp_so3(ramp * share(turn.norm(), settings_.reacquisition_turn_rate, dt) * turn);
  X.linear() = Quaterniond(R).normalized().toRotationMatrix();  // so that rounding errors do not accumulate
  return X;
}

void Reacquisition::note_loss(double t) {
  if (std::exchange(loss_noted_, true)) return;
  ++counts_.losses;
  if (settings_.on_loss == OnLoss::release) releases_.push_back(t);
}

std::optional<double> Reacquisition::take_release(double until) {
  if (newest_ && lost_at() <= until) note_loss(lost_at());
  if (releases_.empty() || releases_.front() > until) return std::nullopt;
  const double t = releases_.front();
  releases_.pop_front();
  return t;
}

void Reacquisition::restart() {
  newest_.reset();
  releases_.clear();
  catching_up_ = false;
  loss_noted_ = false;
}

}  // namespace spring_workbench::hand_input
