#pragma once

#include <deque>
#include <optional>
#include <vector>

#include "spring_workbench/hand_input/settings.h"
#include "spring_workbench/motion/pose_track.h"

namespace spring_workbench::hand_input {

/// Counts for the hand so far.
struct ReacquisitionCounts {
  std::size_t late = 0;            ///< samples that arrived after their time had been simulated
  std::size_t reacquisitions = 0;  ///< times the hand was re-acquired
  std::size_t losses = 0;          ///< times `loss_timeout` passed without a sample
};

/// The hand that the simulation follows: the tracked one or, after that was lost and found elsewhere, one that starts
/// at rest from where it was held and catches up.
///
/// From sample to sample the followed pose moves by the tracked hand's own step and in addition towards it: at
/// `reacquisition_speed` and `reacquisition_turn_rate`, and at the end with a time constant of 0.1 s. Both are ramped
/// up smoothly over 0.2 s. So the followed hand is faster than the tracked one by these two at most.
class Reacquisition {
 public:
  explicit Reacquisition(const InputSettings& settings) : settings_(settings) {}

  /// The samples to follow after this one, in order: none if it is not later than `simulated_until` [s] (it is late);
  /// two if the hand was held beyond the last one. `relocation`: see GateResult.
  std::vector<motion::PoseSample> follow(const motion::PoseSample& sample, bool relocation, double simulated_until);
  /// The next time up to `until` [s], if any, at which the held object is released because the hand was lost. Each is
  /// returned once, and none if `on_loss` is freeze.
  std::optional<double> take_release(double until);
  const ReacquisitionCounts& counts() const { return counts_; }
  /// Forgets the hand; keeps the counts.
  void restart();

 private:
  void set_out(const motion::PoseSample& sample);
  RigidTransform catch_up(const motion::PoseSample& sample);
  double lost_at() const { return newest_->t + settings_.loss_timeout; }
  void note_loss(double t);

  InputSettings settings_;
  std::optional<motion::PoseSample> newest_;  ///< followed
  motion::PoseSample tracked_;                ///< the newest one, as it was tracked
  bool catching_up_ = false;
  double set_out_at_ = 0.0;      ///< [s]
  bool loss_noted_ = false;      ///< of the time since `newest_`
  std::deque<double> releases_;  ///< not taken yet
  ReacquisitionCounts counts_;
};

}  // namespace spring_workbench::hand_input
