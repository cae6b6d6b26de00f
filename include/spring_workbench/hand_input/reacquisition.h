#pragma once

#include <deque>
#include <optional>
#include <vector>

#include "spring_workbench/hand_input/settings.h"
#include "spring_workbench/motion/pose_track.h"

namespace spring_workbench::hand_input {

/// Counts of losses and re-acquisitions of one hand.
struct ReacquisitionCounts {
  std::size_t late = 0;            ///< samples that arrived after their time had been simulated
  std::size_t reacquisitions = 0;  ///< times the hand was re-acquired
  std::size_t losses = 0;          ///< times `loss_timeout` passed without a sample
};

/// Computes the pose of the hand that the simulation follows. This is the tracked pose or, if the hand was lost and
/// found elsewhere, a pose that starts at rest where the hand was last and catches up. InputFilter has one for each
/// hand.
///
/// With each sample the followed pose moves by the step of the tracked hand, and towards the tracked pose at no more
/// than `reacquisition_speed` and `reacquisition_turn_rate`, at the end with a time constant of 0.1 s. In the first
/// 0.2 s both parts are scaled by a factor that rises smoothly from 0 to 1.
class Reacquisition {
 public:
  explicit Reacquisition(const InputSettings& settings) : settings_(settings) {}  ///< copies the settings

  /// Returns the samples to follow, in order, after this tracked one (pose in world). It returns no sample if this one
  /// is late, that is, not later than `simulated_until` [s]. It returns two if the hand was held at rest beyond the
  /// last sample. `relocation`: see GateResult.
  std::vector<motion::PoseSample> follow(const motion::PoseSample& sample, bool relocation, double simulated_until);
  /// Returns the next time up to `until` [s], if any, at which the held object is released because the hand was lost.
  /// Each time is returned once. If `on_loss` is freeze, there is none.
  std::optional<double> take_release(double until);
  const ReacquisitionCounts& counts() const { return counts_; }  ///< counts since the start
  /// Forgets the samples of the hand. Counts are kept.
  void restart();

 private:
  void begin_catch_up(const motion::PoseSample& sample);
  RigidTransform catch_up(const motion::PoseSample& sample);
  double lost_at() const { return newest_->t + settings_.loss_timeout; }
  void note_loss(double t);

  InputSettings settings_;
  std::optional<motion::PoseSample> newest_;  ///< followed
  motion::PoseSample tracked_;                ///< the newest one, as it was tracked
  bool catching_up_ = false;
  double catch_up_began_ = 0.0;  ///< [s]
  bool loss_noted_ = false;      ///< the current loss is counted
  std::deque<double> releases_;  ///< not taken yet
  ReacquisitionCounts counts_;
};

}  // namespace spring_workbench::hand_input
