#pragma once

#include <map>
#include <optional>
#include <string>

#include "spring_workbench/hand_input/settings.h"
#include "spring_workbench/math/rigid_transform.h"

namespace spring_workbench::hand_input {

/// A sample as received, not checked yet.
struct RawSample {
  double t = 0.0;                           ///< stamp [s]
  Vector3d p = Vector3d::Zero();            ///< origin of the tracked frame, in the tracker's frame [m]
  Quaterniond q = Quaterniond::Identity();  ///< its rotation; not necessarily of length 1
};

/// Result of the gate for a sample.
enum class GateResult {
  accepted,    ///< continues from the sample before
  relocation,  ///< accepted, but not from where the last one was: after a jump or a dropout, or the first of all
  not_finite,
  bad_quaternion,  ///< far from unit length
  too_far,
  not_later,  ///< repeated or backward stamp
  too_close,  ///< a stamp right after the last one, as in a burst: a velocity over so short a time means nothing
  too_fast,
  turns_too_fast,
  out_of_view,
};
/// Whether a sample with this result may be used.
inline bool usable(GateResult result) { return result == GateResult::accepted || result == GateResult::relocation; }
/// The result in words, as in /diagnostics.
std::string to_string(GateResult result);
/// What is wrong with a rejected sample: field, rule and value.
std::string complaint(GateResult result, const RawSample& sample, const InputSettings& settings);

/// Whether a sample is a pose in reach, regardless of earlier samples: accepted, not_finite, bad_quaternion or
/// too_far.
GateResult check_pose(const RawSample& sample, const InputSettings& settings);

/// Counts of the gate so far.
struct GateCounts {
  std::size_t accepted = 0;
  std::size_t relocations = 0;  ///< jumps that were accepted
  std::size_t dropouts = 0;     ///< gaps between accepted samples longer than `dropout_after`
  std::size_t sign_flips = 0;   ///< neighbours whose quaternions have opposite signs; harmless
  std::map<GateResult, std::size_t> rejected;
};

/// Accepts the samples of one station that a hand can have made. A sample too far from the last accepted one for the
/// time between them is rejected, until `accept_after` consecutive samples agree with each other: then the new position
/// is accepted. The time between samples counts as `dropout_after` at most, so that a long gap does not admit
/// everything.
class SampleGate {
 public:
  /// `dropout_after` [s], > 0: a longer gap is a dropout, and the next sample a relocation.
  SampleGate(const InputSettings& settings, double dropout_after);

  GateResult offer(const RawSample& sample);
  const GateCounts& counts() const { return counts_; }
  /// Forgets the samples, for a time jump; keeps the counts.
  void restart();

 private:
  GateResult judge(const RawSample& sample) const;
  GateResult judge_move(const RawSample& from, const RawSample& to) const;
  bool is_out_of_view(const RawSample& sample) const;
  bool confirmed(const RawSample& sample);
  /// A sample that is in reach only because time has passed, at a position that was out of reach before.
  bool is_from_candidate(const RawSample& sample) const;
  GateResult accept(const RawSample& sample, bool jumped);

  InputSettings settings_;
  double dropout_after_;
  GateCounts counts_;
  std::optional<RawSample> newest_;     ///< accepted
  double interval_ = 0.0;               ///< between accepted samples, smoothed [s]
  std::optional<RawSample> candidate_;  ///< the newest one that was too far off
  int in_a_row_ = 0;                    ///< samples up to `candidate_` that agree with each other
};

}  // namespace spring_workbench::hand_input
