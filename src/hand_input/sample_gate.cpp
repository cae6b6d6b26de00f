#include "spring_workbench/hand_input/sample_gate.h"

#include <algorithm>
#include <cmath>
#include <sstream>

#include "constants.h"

namespace spring_workbench::hand_input {
namespace {

// Smaller motions are never outliers, but noise of the tracker or of closely spaced stamps.

std::string text(double value) {
  std::ostringstream out;
  out << value;
  return out.str();
}

/// Angle of the rotation from a to b [rad], 0 … π, irrespective of the signs of the quaternions.
double angle_between(const Quaterniond& a, const Quaterniond& b) {
  return 2.0 * std::atan2((a.conjugate() * b).vec().norm(), std::abs(a.dot(b)));
}

}  // namespace

std::string to_string(GateResult result) {
  static const char* const names[] = {"accepted",         "relocation",      "not finite",      "not a unit quaternion",
                                      "position too far", "stamp not later", "stamp too close", "too fast",
                                      "turns too fast",   "out of view"};
  return names[static_cast<std::size_t>(result)];
}

std::string complaint(GateResult result, const RawSample& sample, const InputSettings& settings) {
  const auto& p = sample.p;
  const auto& q = sample.q;
  const std::string stamp = "stamp " + text(sample.t) + " s ";
  const std::string position = "position (" + text(p.x()) + ", " + text(p.y()) + ", " + text(p.z()) + ") m ";
  const std::string rotation =
      "rotation (" + text(q.x()) + ", " + text(q.y()) + ", " + text(q.z()) + ", " + text(q.w()) + ") ";
  const std::string begin = to_string(result) + ": ";
  switch (result) {
    case GateResult::accepted:
    case GateResult::relocation:
      return "";
    case GateResult::not_finite:
      return begin + (!std::isfinite(sample.t) ? stamp : p.allFinite() ? rotation : position) + "is not finite";
    case GateResult::bad_quaternion:
      return begin + rotation + "has a length that differs from 1 by more than input.quaternion_tolerance = " +
             text(settings.quaternion_tolerance);
    case GateResult::too_far:
      return begin + position + "is farther from the origin than input.max_distance = " + text(settings.max_distance) +
             " m";
    case GateResult::not_later:
      return begin + stamp + "is not later than that of the last sample";
    case GateResult::stamp_too_close:
      return begin + stamp + "is less than a quarter of the usual interval after that of the last sample";
    case GateResult::too_fast:
      return begin + position + "cannot be reached from the last one at input.max_speed = " + text(settings.max_speed) +
             " m/s";
    case GateResult::turns_too_fast:
      return begin + rotation +
             "cannot be reached from the last one at input.max_turn_rate = " + text(settings.max_turn_rate) + " rad/s";
    case GateResult::out_of_view:
      return begin + position + "is within input.origin_radius = " + text(settings.origin_radius) +
             " m of the origin and the rotation within input.origin_angle = " + text(settings.origin_angle) +
             " rad of the identity, which is what trackers send while the sensor is out of view";
  }
  return "";
}

GateResult check_pose(const RawSample& sample, const InputSettings& settings) {
  if (!std::isfinite(sample.t) || !sample.p.allFinite() || !sample.q.coeffs().allFinite())
    return GateResult::not_finite;
  if (!(std::abs(sample.q.norm() - 1.0) <= settings.quaternion_tolerance)) return GateResult::bad_quaternion;
  return sample.p.norm() <= settings.max_distance ? GateResult::accepted : GateResult::too_far;
}

SampleGate::SampleGate(const InputSettings& settings, double dropout_after)
    : settings_(settings), dropout_after_(dropout_after) {}

std::string complaint_about_gaps(const GateCounts& counts, double dropout_after) {
  if (counts.dropouts < 2 || 2 * counts.dropouts < counts.accepted) return "";
  return "samples come " + text(counts.newest_dropout) + " s apart, more than dropout_after = " + text(dropout_after) +
         " s: each gap counts as a dropout, so the hand does not move; increase dropout_after";
}

void SampleGate::restart() {
  newest_.reset();
  candidate_.reset();
  agreeing_samples_ = 0;
  interval_ = 0.0;
}

GateResult SampleGate::offer(const RawSample& sample) {
  GateResult result = judge(sample);
  const bool is_jump = result == GateResult::too_fast || result == GateResult::turns_too_fast;
  if (is_jump && confirmed(sample)) result = GateResult::relocation;
  if (result == GateResult::accepted && is_from_candidate(sample)) result = GateResult::relocation;
  if (usable(result)) return accept(sample, result == GateResult::relocation);
  ++counts_.rejected[result];
  return result;
}

GateResult SampleGate::judge(const RawSample& sample) const {
  const GateResult result = check_pose(sample, settings_);
  if (!usable(result) || !newest_) return result;
  if (!(sample.t - newest_->t >= same_time)) return GateResult::not_later;
  if (sample.t - newest_->t < std::max(closest, closest_share * interval_)) return GateResult::stamp_too_close;
  if (is_out_of_view(sample)) return GateResult::out_of_view;
  return judge_move(*newest_, sample);
}

GateResult SampleGate::judge_move(const RawSample& from, const RawSample& to) const {
  const double dt = std::min(to.t - from.t, dropout_after_);
  if ((to.p - from.p).norm() > free_distance + settings_.max_speed * dt) return GateResult::too_fast;
  if (angle_between(from.q, to.q) > free_angle + settings_.max_turn_rate * dt) return GateResult::turns_too_fast;
  return GateResult::accepted;
}

bool SampleGate::is_out_of_view(const RawSample& sample) const {
  return sample.p.norm() <= settings_.origin_radius && settings_.origin_radius > 0.0 &&
         angle_between(sample.q, Quaterniond::Identity()) <= settings_.origin_angle &&
         newest_->p.norm() > away_from_origin * settings_.origin_radius;
}

bool SampleGate::confirmed(const RawSample& sample) {
  const bool later = !candidate_ || sample.t - candidate_->t >= same_time;
  if (!later) return false;
  const bool fits = candidate_ && judge_move(*candidate_, sample) == GateResult::accepted;
  agreeing_samples_ = fits ? agreeing_samples_ + 1 : 1;
  candidate_ = sample;
  return agreeing_samples_ >= settings_.accept_after;
}

bool SampleGate::is_from_candidate(const RawSample& sample) const {
  return candidate_ && judge_move(*candidate_, sample) == GateResult::accepted &&
         (sample.p - candidate_->p).norm() < (sample.p - newest_->p).norm();
}

GateResult SampleGate::accept(const RawSample& sample, bool jumped) {
  const bool after_dropout = newest_ && sample.t - newest_->t > dropout_after_;
  const bool first = !newest_;
  if (!first && !after_dropout) {
    const double dt = sample.t - newest_->t;
    interval_ = interval_ > 0.0 ? interval_ + new_interval_weight * (dt - interval_) : dt;
  }
  counts_.dropouts += after_dropout ? 1 : 0;
  if (after_dropout) counts_.newest_dropout = sample.t - newest_->t;
  counts_.relocations += jumped ? 1 : 0;
  counts_.sign_flips += newest_ && newest_->q.dot(sample.q) < 0.0 ? 1 : 0;
  ++counts_.accepted;
  newest_ = sample;
  newest_->q.normalize();
  candidate_.reset();
  agreeing_samples_ = 0;
  return first || after_dropout || jumped ? GateResult::relocation : GateResult::accepted;
}

}  // namespace spring_workbench::hand_input
