#pragma once

#include <vector>

#include "spring_workbench/hand_input/local_time.h"
#include "spring_workbench/hand_input/reacquisition.h"
#include "spring_workbench/hand_input/sample_gate.h"
#include "spring_workbench/simulation/simulation.h"

namespace spring_workbench::hand_input {

/// The one way of all hands into a simulation, live and offline. Each hand goes through gate, smoothing and
/// re-acquisition; its playout clock says how far to simulate, to those who have a clock. A hand is a number as for
/// Simulation. Times are the simulation's [s]. No thread, no log, no ROS: the same calls give the same bits.
class Feed {
 public:
  /// Feeds `simulation`, which must outlive it. `simulated_time`: see PlayoutClock.
  Feed(simulation::Simulation& simulation, const InputSettings& settings, bool simulated_time = false);
  ~Feed();

  /// A sample as it came, in a tracker's frame P that is at `X_WP` in world. What the gate rejects goes no further.
  GateResult push_stylus(const RawSample& sample, const RigidTransform& X_WP, const LocalTime& arrival,
                         std::size_t hand = 0);
  /// A pose of the handle in world, of a motion whose samples need no clock. It is pushed as it is to the bit where
  /// nothing is smoothed and the hand was not lost.
  GateResult push_stylus(const motion::PoseSample& sample, std::size_t hand = 0);
  /// See Simulation.
  void push_button(double t, bool pressed, std::size_t hand = 0) { simulation_.push_button(t, pressed, hand); }
  void push_next_tool(double t, std::size_t hand = 0) { simulation_.push_next_tool(t, hand); }
  /// The buttons of a hand are known up to `t`, whether or not one of them changed.
  void buttons_known(double t, const LocalTime& arrival, std::size_t hand = 0);

  /// Whether any hand was pushed since the start.
  bool has_sample() const { return has_sample_; }
  /// As far as the slowest hand allows to simulate; −infinity before the first sample.
  double target(const LocalTime& now) const;
  /// Goes to `t`; lets go of what a hand holds where that is lost on the way, in the order of time.
  simulation::AdvanceReport advance_to(double t);

  /// Forgets the hands, after the simulation was reset or changed: the next sample is a first one. Gates and counts
  /// stay.
  void restart();
  /// Forgets what the gate saw of one hand, for a jump of its time; keeps the counts.
  void restart_gate(std::size_t hand);

  const GateCounts& gate_counts(std::size_t hand) const;
  const ReacquisitionCounts& reacquisition_counts(std::size_t hand) const;

 private:
  struct Hand;
  void follow(const motion::PoseSample& sample, GateResult result, const RigidTransform* X_WP, const LocalTime& arrival,
              std::size_t hand);

  simulation::Simulation& simulation_;
  std::vector<Hand> hands_;
  bool has_sample_ = false;
};

}  // namespace spring_workbench::hand_input
