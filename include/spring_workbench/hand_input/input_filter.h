#pragma once

#include "spring_workbench/hand_input/pose_filter.h"
#include "spring_workbench/hand_input/sample_gate.h"

namespace spring_workbench::hand_input {

/// What a sample became.
struct TrueSample {
  Verdict verdict = Verdict::accepted;
  motion::PoseSample sample;  ///< means something where usable(verdict)
};

/// What stands between a source of one station's samples and whoever follows them: the gate, then the filter.
class TruthLayer {
 public:
  /// `dropout_after` [s], > 0: see SampleGate.
  TruthLayer(const TruthSettings& settings, double dropout_after) : gate_(settings, dropout_after), filter_(settings) {}

  TrueSample take(const RawSample& raw);
  /// The same for a pose that is known to be one, which comes through unchanged to the bit where nothing is filtered.
  TrueSample take(const motion::PoseSample& sample);
  const GateCounts& counts() const { return gate_.counts(); }
  /// Forgets the samples, for a jump of time; keeps the counts.
  void restart();

 private:
  TrueSample pass_on(Verdict verdict, const motion::PoseSample& sample);

  SampleGate gate_;
  PoseFilter filter_;
};

}  // namespace spring_workbench::hand_input
