#pragma once

#include <cstddef>
#include <functional>
#include <limits>
#include <optional>
#include <vector>

#include "spring_workbench/hand_input/local_time.h"
#include "spring_workbench/hand_input/reacquisition.h"
#include "spring_workbench/hand_input/sample_gate.h"
#include "spring_workbench/math/rigid_transform.h"
#include "spring_workbench/simulation/simulation.h"

namespace spring_workbench::hand_input {

/// One input that a feed gave to its simulation. The same inputs in the same order, each after the simulation has
/// reached the same time, give a bit-identical future.
struct Accepted {
  enum class Kind {
    pose,         ///< of the handle at time `t`, as it is followed
    button_down,  ///< the grasp button, at time `t`
    button_up,
    next_tool,  ///< the second button, at time `t`
    lost,       ///< the hand releases its object because it was lost until `t`
    rest,       ///< no input: all hands rested until `t`
    clutch_on,  ///< at time `t`
    clutch_off,
  };
  static Kind kind_of(motion::Press press);
  /// The button's edge; none for what is not about buttons.
  static std::optional<motion::Press> press_of(Kind kind);

  Kind kind = Kind::rest;
  std::size_t hand = 0;
  double t = 0.0;                                               ///< [s]
  RigidTransform X_WH = RigidTransform::Identity();             ///< of a pose
  double committed = -std::numeric_limits<double>::infinity();  ///< simulated time reached before it [s];
                                                                ///< −infinity before the simulation began
};

/// The input of all hands to a simulation, live and offline. Each hand passes gate, smoothing and re-acquisition; its
/// playout clock tells, for callers with a clock, up to which time the hand is known. A hand is a number as for
/// Simulation. Times are simulated [s]. No thread, no log, no ROS: the same calls give bit-identical results.
class Feed {
 public:
  /// Feeds `simulation`, which must outlive it.
  Feed(simulation::Simulation& simulation, const InputSettings& settings);
  ~Feed();

  /// A sample as it came, in a tracker's frame P that is at `X_WP` in world. A sample that the gate rejects is dropped.
  GateResult push_stylus(const RawSample& sample, const RigidTransform& X_WP, const LocalTime& arrival,
                         std::size_t hand = 0);
  /// A sample came that is not used: the hand is not silent.
  void heard(const LocalTime& arrival, std::size_t hand);
  /// A pose of the handle in world, of a motion whose samples need no clock. It is pushed unchanged, bit by bit, if
  /// smoothing is off and the hand was not lost.
  GateResult push_stylus(const motion::PoseSample& sample, std::size_t hand = 0);
  /// See Simulation.
  void push_press(double t, motion::Press press, std::size_t hand = 0);
  void push_button(double t, bool pressed, std::size_t hand = 0) {
    push_press(t, pressed ? motion::Press::grasp : motion::Press::release, hand);
  }
  /// The buttons of a hand are known up to `t`, whether or not one of them changed.
  void buttons_known(double t, const LocalTime& arrival, std::size_t hand = 0);

  /// Whether any hand was pushed since the start.
  bool has_sample() const { return has_sample_; }
  /// The time to which to commit the simulation next, by advance_to: the next sample or button edge up to which all is
  /// known of every hand, except silent ones; whole steps if all are silent. Nothing while there is no such time.
  std::optional<double> next_stop(const LocalTime& now) const;
  /// Simulated time reached since the start [s]; −infinity before it went on.
  double committed() const;
  /// Advances to `t`; a hand that is lost before `t` releases its object at that time.
  simulation::AdvanceReport advance_to(double t);
  /// Gives every hand of a copy of the simulation its predicted pose at `t` (motion::PosePredictor), if that is later
  /// than its newest sample.
  void predict(double t, simulation::Simulation& copy) const;
  /// How long ago the newest sample of all came [s].
  double waited(const LocalTime& now) const;
  /// From now on calls `record` with every input of the simulation; empty: nothing is recorded.
  void record(std::function<void(const Accepted&)> record) { record_ = std::move(record); }

  /// Forgets the hands, after the simulation was reset or changed: the next sample is a first one. Gates and counts
  /// stay.
  void restart();
  /// Forgets the samples that the gate has seen of one hand, for a time jump; keeps the counts.
  void restart_gate(std::size_t hand);

  const GateCounts& gate_counts(std::size_t hand) const;
  const ReacquisitionCounts& reacquisition_counts(std::size_t hand) const;
  /// How often a hand's tracker was moved in world: another X_WP than before, after which the hand is re-acquired.
  std::size_t tracker_moves(std::size_t hand) const;

 private:
  struct Hand;
  void follow(const motion::PoseSample& sample, GateResult result, const RigidTransform* X_WP, const LocalTime& arrival,
              std::size_t hand);

  void note(Accepted::Kind kind, std::size_t hand, double t,
            const RigidTransform& X_WH = RigidTransform::Identity()) const;

  simulation::Simulation& simulation_;
  std::vector<Hand> hands_;
  std::function<void(const Accepted&)> record_;
  bool has_sample_ = false;
  bool began_ = false;  ///< time has gone on since the start
};

}  // namespace spring_workbench::hand_input
