#include "spring_workbench/hand_input/sample_gate.h"

#include <algorithm>
#include <cmath>
#include <sstream>

namespace spring_workbench::hand_input {
namespace {

// Below these a move is never an outlier: noise of a tracker, and of stamps that are close together.
constexpr double kFreeDistance = 5e-3;        // [m]
constexpr double kFreeAngle = 0.05;           // [rad]
constexpr double kShortestInterval = 0.5e-9;  // [s] half of what ROS time resolves, as PoseTrack has it
constexpr double kClosest = 5e-5;             // [s] and no closer than kClosestShare of the usual interval
constexpr double kClosestShare = 0.25;
constexpr double kAwayFromOrigin = 10.0;  // radii; a hand that was nearer may have come to the origin by itself

/// Angle of the rotation from a to b [rad], 0 … π, the signs of the quaternions aside.
double angle_between(const Quaterniond& a, const Quaterniond& b) {
  return 2.0 * std::atan2((a.conjugate() * b).vec().norm(), std::abs(a.dot(b)));
}

}  // namespace

std::string to_string(Verdict verdict) {
  switch (verdict) {
    case Verdict::accepted:
      return "accepted";
    case Verdict::new_place:
      return "new place";
    case Verdict::not_finite:
      return "not finite";
    case Verdict::bad_quaternion:
      return "not a unit quaternion";
    case Verdict::too_far:
      return "too far";
    case Verdict::not_later:
      return "stamp not later";
    case Verdict::too_close:
      return "too close to the last";
    case Verdict::too_fast:
      return "too fast";
    case Verdict::turns_too_fast:
      return "turns too fast";
    case Verdict::out_of_view:
      return "out of view";
  }
  return "";
}

std::string complaint(Verdict verdict, const RawSample& sample, const TruthSettings& settings) {
  std::ostringstream out;
  const auto& p = sample.p;
  const auto& q = sample.q;
  std::ostringstream position, rotation;
  position << "position: (" << p.x() << ", " << p.y() << ", " << p.z() << ") is not allowed: must be ";
  rotation << "rotation: (" << q.x() << ", " << q.y() << ", " << q.z() << ", " << q.w() << ") is not allowed: must be ";
  switch (verdict) {
    case Verdict::accepted:
    case Verdict::new_place:
      break;
    case Verdict::not_finite:
      if (!std::isfinite(sample.t)) {
        out << "stamp: " << sample.t << " is not allowed: must be a finite number";
      } else {
        out << (p.allFinite() ? rotation.str() : position.str()) << "finite numbers";
      }
      break;
    case Verdict::bad_quaternion:
      out << rotation.str() << "of length 1 within quaternion_tolerance = " << settings.quaternion_tolerance;
      break;
    case Verdict::too_far:
      out << position.str() << "within max_distance = " << settings.max_distance << " m";
      break;
    case Verdict::not_later:
      out << "stamp: " << sample.t << " s is not allowed: must be later than the last one";
      break;
    case Verdict::too_close:
      out << "stamp: " << sample.t << " s is not allowed: must be a quarter of the usual interval after the last one";
      break;
    case Verdict::too_fast:
      out << position.str() << "reached at max_speed = " << settings.max_speed << " m/s or less";
      break;
    case Verdict::turns_too_fast:
      out << rotation.str() << "reached at max_turn_rate = " << settings.max_turn_rate << " rad/s or less";
      break;
    case Verdict::out_of_view:
      out << position.str() << "farther than origin_radius = " << settings.origin_radius << " m from the origin";
      break;
  }
  return out.str();
}

SampleGate::SampleGate(const TruthSettings& settings, double dropout_after)
    : settings_(settings), dropout_after_(dropout_after) {}

void SampleGate::restart() {
  newest_.reset();
  candidate_.reset();
  in_a_row_ = 0;
  interval_ = 0.0;
}

Verdict SampleGate::offer(const RawSample& sample) {
  Verdict verdict = judge(sample);
  const bool is_jump = verdict == Verdict::too_fast || verdict == Verdict::turns_too_fast;
  if (is_jump && confirmed(sample)) verdict = Verdict::new_place;
  if (verdict == Verdict::accepted && is_from_candidate(sample)) verdict = Verdict::new_place;
  if (usable(verdict)) return accept(sample, verdict == Verdict::new_place);
  ++counts_.left_out[verdict];
  return verdict;
}

Verdict SampleGate::judge(const RawSample& sample) const {
  if (!std::isfinite(sample.t) || !sample.p.allFinite() || !sample.q.coeffs().allFinite()) return Verdict::not_finite;
  if (!(std::abs(sample.q.norm() - 1.0) <= settings_.quaternion_tolerance)) return Verdict::bad_quaternion;
  if (!(sample.p.norm() <= settings_.max_distance)) return Verdict::too_far;
  if (!newest_) return Verdict::accepted;
  if (!(sample.t - newest_->t >= kShortestInterval)) return Verdict::not_later;
  if (sample.t - newest_->t < std::max(kClosest, kClosestShare * interval_)) return Verdict::too_close;
  if (is_out_of_view(sample)) return Verdict::out_of_view;
  return judge_move(*newest_, sample);
}

Verdict SampleGate::judge_move(const RawSample& from, const RawSample& to) const {
  const double dt = std::min(to.t - from.t, dropout_after_);
  if ((to.p - from.p).norm() > kFreeDistance + settings_.max_speed * dt) return Verdict::too_fast;
  if (angle_between(from.q, to.q) > kFreeAngle + settings_.max_turn_rate * dt) return Verdict::turns_too_fast;
  return Verdict::accepted;
}

bool SampleGate::is_out_of_view(const RawSample& sample) const {
  return sample.p.norm() <= settings_.origin_radius && settings_.origin_radius > 0.0 &&
         angle_between(sample.q, Quaterniond::Identity()) <= settings_.origin_angle &&
         newest_->p.norm() > kAwayFromOrigin * settings_.origin_radius;
}

bool SampleGate::confirmed(const RawSample& sample) {
  const bool later = !candidate_ || sample.t - candidate_->t >= kShortestInterval;
  if (!later) return false;
  const bool fits = candidate_ && judge_move(*candidate_, sample) == Verdict::accepted;
  in_a_row_ = fits ? in_a_row_ + 1 : 1;
  candidate_ = sample;
  return in_a_row_ >= settings_.accept_after;
}

bool SampleGate::is_from_candidate(const RawSample& sample) const {
  return candidate_ && judge_move(*candidate_, sample) == Verdict::accepted &&
         (sample.p - candidate_->p).norm() < (sample.p - newest_->p).norm();
}

Verdict SampleGate::accept(const RawSample& sample, bool jumped) {
  const bool after_dropout = newest_ && sample.t - newest_->t > dropout_after_;
  const bool first = !newest_;
  if (!first && !after_dropout) {
    constexpr double share_of_new = 0.1;  // smooths over some ten samples
    const double dt = sample.t - newest_->t;
    interval_ = interval_ > 0.0 ? interval_ + share_of_new * (dt - interval_) : dt;
  }
  counts_.dropouts += after_dropout ? 1 : 0;
  counts_.new_places += jumped ? 1 : 0;
  counts_.sign_flips += newest_ && newest_->q.dot(sample.q) < 0.0 ? 1 : 0;
  ++counts_.accepted;
  newest_ = sample;
  newest_->q.normalize();
  candidate_.reset();
  in_a_row_ = 0;
  return first || after_dropout || jumped ? Verdict::new_place : Verdict::accepted;
}

}  // namespace spring_workbench::hand_input
