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

/// Input that a feed gave to its simulation. The same inputs in the same order, each after the simulation has reached
/// the same time, give a bit-identical future.
struct AcceptedInput {
  /// What kind of input it is.
  enum class Kind {
    pose,             ///< pose of the stylus at time `t`, after filtering
    button_down,      ///< the grasp button went down at time `t`
    button_up,        ///< the grasp button went up at time `t`
    next_tool,        ///< the second button went down at time `t`
    lost,             ///< the hand was lost and releases its object at time `t`
    rest,             ///< no input: all hands are at rest until time `t`
    clutch_on,        ///< the clutch button went down at time `t`
    clutch_off,       ///< the clutch button went up at time `t`
    external_wrench,  ///< a machine's force sensor measured `wrench` at time `t`
  };
  static Kind kind_of(motion::ButtonEdge edge);  ///< the kind that stands for a button edge
  /// Returns the edge of a button that `kind` stands for; none if it stands for something else.
  static std::optional<motion::ButtonEdge> edge_of(Kind kind);

  Kind kind = Kind::rest;                                       ///< what kind of input it is
  std::size_t hand = 0;                                         ///< the hand, from 0
  double t = 0.0;                                               ///< time of the input [s]
  RigidTransform X_WS = RigidTransform::Identity();             ///< pose of the stylus in world, for `pose`
  motion::ExternalWrench wrench;                                ///< for `external_wrench`, measured at time `t`
  double committed = -std::numeric_limits<double>::infinity();  ///< simulated time at which the input was given [s];
                                                                ///< −infinity before the first advance
};

/// Input of all hands to a simulation, live and offline. The samples of each hand pass the outlier gate, smoothing and
/// re-acquisition. For callers with a clock, the hand's playout clock determines up to which time its input is
/// complete. Hands are numbered as in Simulation; times are simulated times [s]. There is no thread, log or ROS: the
/// same calls give bit-identical results.
class Feed {
 public:
  /// Whether the hands' motion is predicted, which costs time for every sample.
  enum class Prediction { off, on };
  /// Feeds `simulation`, which must outlive it.
  Feed(simulation::Simulation& simulation, const InputSettings& settings, Prediction prediction = Prediction::off);
  ~Feed();

  /// Adds a sample as received, in a tracker's frame P whose pose in the world is `X_WP`. Returns the result of the
  /// gate; a rejected sample is dropped.
  GateResult push_stylus(const RawSample& sample, const RigidTransform& X_WP, const LocalTime& arrival,
                         std::size_t hand = 0);
  /// Reports the arrival of a sample that is not used, so that the hand does not count as silent.
  void report_arrival(const LocalTime& arrival, std::size_t hand);
  /// Adds a pose of the stylus in the world, from a motion that needs no clock. The pose is passed on
  /// bit-identically if smoothing and dead band are off and the hand was not lost. `quaternion_norm`: length of the
  /// quaternion as it was received.
  GateResult push_stylus(const motion::PoseSample& sample, std::size_t hand = 0, double quaternion_norm = 1.0);
  /// Adds a button edge at time `t` [s]; see Simulation::push_edge().
  void push_edge(double t, motion::ButtonEdge edge, std::size_t hand = 0);
  /// Presses or releases the grasp button at time `t` [s].
  void push_button(double t, bool pressed, std::size_t hand = 0) {
    push_edge(t, pressed ? motion::ButtonEdge::grasp : motion::ButtonEdge::release, hand);
  }
  /// Adds what a machine's force sensor measured; see Simulation::push_external_wrench(). Time never waits for such a
  /// sample.
  void push_external_wrench(const motion::ExternalWrench& sample, std::size_t hand = 0);
  /// Reports that the buttons of a hand are known up to `t`, whether or not one of them changed.
  void buttons_known(double t, const LocalTime& arrival, std::size_t hand = 0);

  /// Returns whether a sample of any hand was pushed since the start.
  bool has_sample() const { return has_sample_; }
  /// Returns the time to which advance_to should commit the simulation next: the next sample or button edge up to which
  /// the input of every hand that is not silent is complete, or a whole step further if all hands are silent. None
  /// while there is no such time.
  std::optional<double> next_stop(const LocalTime& now) const;
  /// Returns the simulated time reached since the start [s]; −infinity before the first advance.
  double committed() const;
  /// Advances the simulation to `t`. A hand that is lost before `t` releases its object at the time of the loss.
  simulation::AdvanceReport advance_to(double t);
  /// Gives each hand of `copy`, a copy of the simulation, the samples by which it follows its predicted motion up to
  /// time `t`; they also determine its velocity at the newest true sample. None without Prediction::on.
  void predict(double t, simulation::Simulation& copy) const;
  /// Returns the time since the newest sample of any hand arrived [s].
  double time_since_arrival(const LocalTime& now) const;
  /// Sets the function that is called with every input of the simulation; empty: nothing is recorded.
  void record(std::function<void(const AcceptedInput&)> record) { record_ = std::move(record); }

  /// Forgets the hands' samples after the simulation was reset or changed: the next sample counts as the first. Gates
  /// and counts are kept.
  void restart();
  /// Forgets the samples of one hand in its gate, after a time jump; keeps the counts.
  void restart_gate(std::size_t hand);

  const GateCounts& gate_counts(std::size_t hand) const;                    ///< results of a hand's outlier gate
  const ReacquisitionCounts& reacquisition_counts(std::size_t hand) const;  ///< losses and re-acquisitions of a hand
  /// Returns how often the tracker of a hand was moved in the world (`X_WP` changed), after which the hand is
  /// re-acquired.
  std::size_t tracker_moves(std::size_t hand) const;

 private:
  struct Hand;
  void follow(const motion::PoseSample& sample, GateResult result, const RigidTransform* X_WP, const LocalTime& arrival,
              std::size_t hand);

  void note(AcceptedInput::Kind kind, std::size_t hand, double t,
            const RigidTransform& X_WS = RigidTransform::Identity()) const;

  simulation::Simulation& simulation_;
  std::vector<Hand> hands_;
  std::function<void(const AcceptedInput&)> record_;
  bool has_sample_ = false;
  bool began_ = false;  ///< the simulation has been advanced since the start
};

}  // namespace spring_workbench::hand_input
