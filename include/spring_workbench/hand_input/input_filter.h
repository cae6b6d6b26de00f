#pragma once

#include <cstddef>
#include <functional>
#include <limits>
#include <map>
#include <optional>
#include <vector>

#include "spring_workbench/hand_input/local_time.h"
#include "spring_workbench/hand_input/reacquisition.h"
#include "spring_workbench/hand_input/sample_gate.h"
#include "spring_workbench/math/rigid_transform.h"
#include "spring_workbench/simulation/simulation.h"

namespace spring_workbench::hand_input {

/// Input that an input filter passed on to its simulation, for a record of a run. The same inputs in the same order,
/// each given at the same simulated time (`committed`), lead to a bit-identical future.
struct AcceptedInput {
  /// Kind of an input.
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
  /// Returns the button edge that `kind` stands for, or nothing if it stands for another input.
  static std::optional<motion::ButtonEdge> edge_of(Kind kind);

  Kind kind = Kind::rest;                            ///< kind of the input
  std::size_t hand = 0;                              ///< number of the hand, from 0
  double t = 0.0;                                    ///< time of the input [s]
  RigidTransform X_WS = RigidTransform::Identity();  ///< for `pose`: pose of the stylus in world
  motion::ExternalWrench wrench;                     ///< for `external_wrench`: the wrench, measured at time `t`
  /// Simulated time at which the input was given [s]; −infinity before the first advance.
  double committed = -std::numeric_limits<double>::infinity();
  double target = committed;  ///< time that an interrupted advance was heading for [s]; otherwise `committed`
};

/// Filter between a tracker and a simulation, for callers with raw samples, which have noise, outliers and dropouts.
/// Callers with clean poses do not need it: they call Simulation::push_stylus(). A live loop, with the pose X_WP of the
/// tracker in world and one steady clock:
///
///     hand_input::InputFilter filter(simulation, {});
///     while (running()) {
///       const hand_input::LocalTime now{seconds(), running_seconds()};  // by two clocks: see LocalTime
///       while (const std::optional<hand_input::RawSample> raw = receive()) filter.push_stylus(*raw, X_WP, now);
///       while (const std::optional<double> t = filter.next_target(now)) filter.advance_to(*t);
///     }
///
/// The samples of each hand pass an outlier gate (SampleGate), smoothing, and re-acquisition (Reacquisition). In a live
/// loop next_target() decides up to which time the input is complete, so that the result does not depend on when
/// messages arrive. Offline, push all samples and then call advance_to() for any time. Hands are numbered as in
/// Simulation; another number throws InputError. Times are those of the hand's clock [s]. A filter has no thread; the
/// same calls give bit-identical results on processors of the same kind.
class InputFilter {
 public:
  /// Whether the motion of the hands is predicted.
  enum class Prediction {
    off,  ///< predict() is not used
    on,   ///< predict() may be used; costs time for every sample
  };
  /// Feeds `simulation`, which must outlive the input filter.
  InputFilter(simulation::Simulation& simulation, const InputSettings& settings,
              Prediction prediction = Prediction::off);
  ~InputFilter();

  /// Adds a sample as received, in a tracker's frame P whose pose in world is `X_WP`. `arrival`: the local time now.
  /// Returns the result of the gate. A rejected sample is dropped.
  GateResult push_stylus(const RawSample& sample, const RigidTransform& X_WP, const LocalTime& arrival,
                         std::size_t hand = 0);
  /// Reports the arrival of a sample that the caller does not use, so that the hand does not count as silent.
  void report_arrival(const LocalTime& arrival, std::size_t hand);
  /// Adds a pose of the stylus in world, from a recording or another source that needs no clock. The pose is passed on
  /// bit-identically if smoothing and dead band are off and the hand was not lost. `quaternion_norm`: length of the
  /// quaternion as it was received. Returns the result of the gate.
  GateResult push_stylus(const motion::PoseSample& sample, std::size_t hand = 0, double quaternion_norm = 1.0);
  /// Adds a button edge at time `t` [s]; see Simulation::push_edge().
  void push_edge(double t, motion::ButtonEdge edge, std::size_t hand = 0);
  /// Presses or releases the grasp button at time `t` [s].
  void push_button(double t, bool pressed, std::size_t hand = 0) {
    push_edge(t, pressed ? motion::ButtonEdge::grasp : motion::ButtonEdge::release, hand);
  }
  /// Adds a measurement of a machine's force sensor; see Simulation::push_external_wrench(). Unlike poses, wrenches are
  /// not waited for: the simulation may pass their time before they arrive.
  void push_external_wrench(const motion::ExternalWrench& sample, std::size_t hand = 0);
  /// Reports that the buttons of a hand are known up to time `t` [s], whether or not one of them changed.
  void confirm_buttons(double t, const LocalTime& arrival, std::size_t hand = 0);

  /// Returns whether a sample of any hand was accepted since the start.
  bool has_sample() const { return has_sample_; }
  /// Returns the time [s] to which to call advance_to() next, or nothing if more input has to arrive first. This is the
  /// time of the next sample or button edge, if the input of every hand that is not silent is complete up to it. If all
  /// hands are silent, it is a whole step ahead. While an advance is interrupted, it is its target().
  std::optional<double> next_target(const LocalTime& now) const;
  /// Returns the simulated time that was reached [s]; −infinity before the first advance.
  double committed() const;
  bool is_interrupted() const { return target_.has_value(); }  ///< whether advance_to() paused on its way
  /// Returns the time that an interrupted advance is heading for [s]; committed() if none is.
  double target() const { return target_.value_or(committed()); }
  /// Advances the simulation to time `t` [s]. With `on_loss: release`, a hand that is lost before `t` releases its
  /// object at the time of the loss. The advance is interrupted after the step that reaches `pause_at` [s]; going on
  /// with next_target() then takes the same steps as without a pause.
  simulation::AdvanceReport advance_to(double t, double pause_at = std::numeric_limits<double>::infinity());
  /// Extends the motion of each hand of `copy`, a copy of the simulation, to time `t` [s] by predicted samples, for
  /// display. Does nothing unless prediction is on. Note that this also changes the velocity at the newest real sample
  /// of `copy`.
  void predict(double t, simulation::Simulation& copy) const;
  /// Returns the time since the newest sample of any hand arrived [s]; 0 before the first one.
  double time_since_arrival(const LocalTime& now) const;
  /// Sets a function that is called with every input that the simulation is given. An empty function records nothing.
  void record(std::function<void(const AcceptedInput&)> record) { record_ = std::move(record); }

  /// Forgets the samples of all hands, after the simulation was reset or changed. The next sample counts as the first.
  /// Gates and counts are kept.
  void restart();
  /// Forgets the samples of one hand in its gate, after a jump of time. Counts are kept.
  void restart_gate(std::size_t hand);

  const GateCounts& gate_counts(std::size_t hand) const;                    ///< results of a hand's outlier gate
  const ReacquisitionCounts& reacquisition_counts(std::size_t hand) const;  ///< losses and re-acquisitions of a hand
  /// Returns how often the tracker of a hand was moved in world, that is, `X_WP` changed. After each move the hand is
  /// re-acquired.
  std::size_t tracker_moves(std::size_t hand) const;

 private:
  struct Hand;
  const Hand& hand_at(std::size_t index) const;
  Hand& hand_at(std::size_t index);
  void follow(const motion::PoseSample& sample, GateResult result, const RigidTransform* X_WP, const LocalTime& arrival,
              std::size_t hand);

  void note(AcceptedInput::Kind kind, std::size_t hand, double t,
            const RigidTransform& X_WS = RigidTransform::Identity()) const;

  simulation::Simulation& simulation_;
  std::vector<Hand> hands_;
  std::function<void(const AcceptedInput&)> record_;
  bool has_sample_ = false;
  bool began_ = false;                           ///< the simulation has been advanced since the start
  std::optional<double> target_;                 ///< of an interrupted advance [s]
  std::multimap<double, std::size_t> releases_;  ///< hands that were lost, by the time of the loss [s]
};

}  // namespace spring_workbench::hand_input
