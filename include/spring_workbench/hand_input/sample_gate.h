#pragma once

#include <map>
#include <optional>
#include <string>

#include "spring_workbench/hand_input/settings.h"
#include "spring_workbench/math/rigid_transform.h"

namespace spring_workbench::hand_input {

/// A sample as received, before any check.
struct RawSample {
  double t = 0.0;                           ///< time stamp [s]
  Vector3d p = Vector3d::Zero();            ///< origin of the tracked frame, in the tracker's frame [m]
  Quaterniond q = Quaterniond::Identity();  ///< rotation of the tracked frame; not necessarily of length 1
};

/// Result of the gate for a sample.
enum class GateResult {
  accepted,         ///< accepted: it continues the motion of the sample before
  relocation,       ///< accepted after a jump or a dropout, or as the first sample
  not_finite,       ///< rejected: a number is NaN or infinite
  bad_quaternion,   ///< rejected: the quaternion is far from unit length
  too_far,          ///< rejected: farther than `max_distance` from the origin of the tracker's frame
  not_later,        ///< rejected: the stamp is not later than the last one
  stamp_too_close,  ///< rejected: the stamp is too close to the last one for a meaningful velocity, as in a burst
  too_fast,         ///< rejected: faster than `max_speed` since the last accepted sample
  turns_too_fast,   ///< rejected: turned faster than `max_turn_rate` since the last accepted sample
  out_of_view,      ///< rejected: a jump to the identity, which a tracker sends for a sensor that it does not see
};
/// Returns whether a sample with this result may be used: accepted or relocation.
inline bool usable(GateResult result) { return result == GateResult::accepted || result == GateResult::relocation; }
/// Returns the result in words, as in /diagnostics.
std::string to_string(GateResult result);
/// Returns why a sample is rejected: to_string(), then field, value and rule with the name of its setting.
std::string complaint(GateResult result, const RawSample& sample, const InputSettings& settings);

/// Checks whether a sample is a valid pose within range, regardless of earlier samples. Returns accepted, not_finite,
/// bad_quaternion or too_far.
GateResult check_pose(const RawSample& sample, const InputSettings& settings);

/// Counts of the results of one gate.
struct GateCounts {
  std::size_t accepted = 0;                    ///< samples that were accepted
  std::size_t relocations = 0;                 ///< jumps that were accepted
  std::size_t dropouts = 0;                    ///< gaps between accepted samples longer than `dropout_after`
  double newest_dropout = 0.0;                 ///< length of the newest dropout [s]
  std::size_t sign_flips = 0;                  ///< pairs of neighbours with quaternions of opposite sign; harmless
  std::map<GateResult, std::size_t> rejected;  ///< number of rejected samples by result
};

/// Returns a message about a hand that does not move because most of its samples come farther apart than
/// `dropout_after` [s]. Returns an empty text for any other hand.
std::string complaint_about_gaps(const GateCounts& counts, double dropout_after);

/// Outlier gate for the samples of one hand, in the tracker's frame: it accepts only motions that a hand can make. A
/// sample that is too far from the last accepted one for the time between them is rejected. Once `accept_after`
/// consecutive samples agree with each other, the new position is accepted as a relocation. The time between samples
/// counts as at most `dropout_after`, so that a long gap does not admit everything.
class SampleGate {
 public:
  /// `dropout_after` [s], > 0: a longer gap between samples is a dropout, and the sample after it is a relocation.
  SampleGate(const InputSettings& settings, double dropout_after);

  GateResult offer(const RawSample& sample);            ///< checks a sample after all that were offered before it
  const GateCounts& counts() const { return counts_; }  ///< counts since the start
  /// Forgets all samples, after a jump of time. Counts are kept.
  void restart();

 private:
  GateResult judge(const RawSample& sample) const;
  GateResult judge_move(const RawSample& from, const RawSample& to) const;
  bool is_out_of_view(const RawSample& sample) const;
  bool confirmed(const RawSample& sample);
  /// Returns whether a sample is within the limits only because time has passed, at a position that was rejected
  /// before.
  bool is_from_candidate(const RawSample& sample) const;
  GateResult accept(const RawSample& sample, bool jumped);

  InputSettings settings_;
  double dropout_after_;
  GateCounts counts_;
  std::optional<RawSample> newest_;     ///< accepted
  double interval_ = 0.0;               ///< between accepted samples, smoothed [s]
  std::optional<RawSample> candidate_;  ///< the newest sample that was too far away
  int agreeing_samples_ = 0;            ///< samples up to `candidate_` that agree with each other
};

}  // namespace spring_workbench::hand_input
