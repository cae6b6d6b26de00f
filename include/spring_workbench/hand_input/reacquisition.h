#pragma once

#include <deque>
#include <optional>
#include <vector>

#include "spring_workbench/hand_input/settings.h"
#include "spring_workbench/motion/pose_track.h"

namespace spring_workbench::hand_input {

/// What became of the hand so far.
struct ReacquisitionCounts {
  std::size_t late = 0;            ///< samples that came after their time had been simulated
  std::size_t reacquisitions = 0;  ///< times the hand was found again
  std::size_t losses = 0;          ///< times `loss_timeout` passed without a sample
};

/// Gives the hand that the simulation follows: the tracked one, but where that is lost and found elsewhere, one that
/// sets out at rest from where it was held and catches up with it.
///
/// From sample to sample the pose followed goes along with the tracked hand's own step, and besides a part of the way
/// to it: at `reacquisition_speed` and `reacquisition_turn_rate`, and at the end with a time constant of 0.1 s. Both
/// come in smoothly over 0.2 s. So the hand that is followed is never quicker than the tracked one by more than these
/// two.
class Reacquisition {
 public:
  explicit Reacquisition(const InputSettings& settings) : settings_(settings) {}

  /// What to follow after this sample, in order: nothing when it is not later than `simulated_until` [s] (it came too
  /// late); two samples when the hand was held beyond the last one. `relocation`: see GateResult.
  std::vector<motion::PoseSample> follow(const motion::PoseSample& sample, bool relocation, double simulated_until);
  /// The next time up to `until` [s] at which the held object is to be let go of because the hand was lost, if any.
  /// Each is told once, and none where `lost` is freeze.
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
