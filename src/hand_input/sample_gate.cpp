#include "spring_workbench/hand_input/sample_gate.h"

#include <algorithm>
#include <cmath>
#include <sstream>

#include "constants.h"
#include "spring_workbench/validation/number_rule.h"

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
  static const char* const names[] = {"accepted",
                                      "relocation",
                                      "not finite",
                                      "not a unit quaternion",
                                      "too far",
                                      "stamp not later",
                                      "too close to the last",
                                      "too fast",
                                      "turns too fast",
                                      "out of view"};
  return names[static_cast<std::size_t>(result)];
}

std::string complaint(GateResult result, const RawSample& sample, const InputSettings& settings) {
  const auto& p = sample.p;
  const auto& q = sample.q;
  std::ostringstream stamp, position, rotation;
  stamp << sample.t << " s";
  position << "(" << p.x() << ", " << p.y() << ", " << p.z() << ")";
  rotation << "(" << q.x() << ", " << q.y() << ", " << q.z() << ", " << q.w() << ")";
  const auto invalid = [](const std::string& field, const std::string& rule, const std::ostringstream& given) {
    return validation::invalid_value("", field, given.str(), rule);
  };
  switch (result) {
    case GateResult::accepted:
    case GateResult::relocation:
      return "";
    case GateResult::not_finite:
      if (!std::isfinite(sample.t)) return invalid("stamp", "a finite number", stamp);
      return p.allFinite() ? invalid("rotation", "finite numbers", rotation)
                           : invalid("position", "finite numbers", position);
    case GateResult::bad_quaternion:
      return invalid("rotation", "a length of 1 within quaternion_tolerance = " + text(settings.quaternion_tolerance),
                     rotation);
    case GateResult::too_far:
      return invalid("position", "one within max_distance = " + text(settings.max_distance) + " m", position);
    case GateResult::not_later:
      return invalid("stamp", "later than the last one", stamp);
    case GateResult::too_close:
      return invalid("stamp", "at least a quarter of the usual sample interval after the last one", stamp);
    case GateResult::too_fast:
      return invalid("position", "one within reach of the last at max_speed = " + text(settings.max_speed) + " m/s",
                     position);
    case GateResult::turns_too_fast:
      return invalid("rotation",
                     "one within reach of the last at max_turn_rate = " + text(settings.max_turn_rate) + " rad/s",
                     rotation);
    case GateResult::out_of_view:
      return invalid("position",
                     "one farther than origin_radius = " + text(settings.origin_radius) +
                         " m from the origin, or the rotation more than origin_angle = " + text(settings.origin_angle) +
                         " rad from the identity",
                     position);
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
         " s: each counts as the return of a lost hand, which does not move; increase dropout_after";
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
  if (sample.t - newest_->t < std::max(closest, closest_share * interval_)) return GateResult::too_close;
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
