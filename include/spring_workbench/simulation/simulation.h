#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "spring_workbench/bodies/body_state.h"
#include "spring_workbench/contact/contact_state.h"
#include "spring_workbench/math/state_archive.h"
#include "spring_workbench/motion/pose_track.h"
#include "spring_workbench/scene/scene.h"
#include "spring_workbench/simulation/settings.h"
#include "spring_workbench/tools/tool_state.h"

namespace spring_workbench::simulation {

/// All of a simulation that its calls change, between two of them: what its future depends on beside its scene and the
/// settings that it was made with. A value, by which a simulation of the same scene and settings goes on bit by bit as
/// the one that was saved (`Simulation::save`, `Simulation::restore`).
class SimulationState {
 public:
  /// Of no simulation.
  SimulationState() = default;

  /// Of all its numbers; the same on every machine.
  std::uint64_t hash() const { return math::hash(words_); }
  bool operator==(const SimulationState& other) const { return scene_ == other.scene_ && words_ == other.words_; }
  bool operator!=(const SimulationState& other) const { return !(*this == other); }

 private:
  friend class Simulation;
  friend std::string serialise(const SimulationState& state);
  friend SimulationState parse_state(const std::string& text);

  std::string scene_;  ///< what must be the same in a simulation that goes on from here
  math::StateArchive::Words words_;
};

/// As one YAML text, which another process can parse: every number with all its bits.
std::string serialise(const SimulationState& state);

/// Throws InputError for what is no such text, or one with a hash that is not its numbers'.
SimulationState parse_state(const std::string& text);

/// A hash as 16 hexadecimal digits.
std::string to_hex(std::uint64_t hash);

/// What a call of `advance` did, or several one after the other.
struct AdvanceReport {
  int steps = 0;                   ///< integrator steps taken
  double simulated_time = 0.0;     ///< [s]
  double position_error = 0.0;     ///< largest estimate of a step's local error [m]
  double angle_error = 0.0;        ///< [rad]
  double energy_added = 0.0;       ///< to the held object and the fork, beyond the work of hand, gravity, damping
                                   ///< and contact [J]; means something where stiffest_omega_dt is below about 1
  double stiffest_omega_dt = 0.0;  ///< ω·dt of the stiffest mode
  int steps_among_movable = 0;     ///< of `steps`, with other movable objects (contact mode `dynamic`)
  int collision_queries = 0;
  int substeps = 0;                 ///< steps tried and taken again shorter, for their error
  int stops = 0;                    ///< steps that met the end of the fork's range
  int steps_fallback = 0;           ///< steps done by an L-stable rule, since the integrator's equation was not solved
  double energy_error = 0.0;        ///< sum of the steps' estimated errors in energy [J]
  int steps_blocked = 0;            ///< steps in which contact left a body no way that was found, and it stayed
  double time_lost = 0.0;           ///< of the steps, in which a body did not follow its equation [s]
  int steps_rejected = 0;           ///< times a step was refused because it would not have been finite or bounded
  std::vector<std::string> active;  ///< e.g. "stretch", "gravity", "collision"
  std::vector<std::string> skipped;

  /// What both did together: sums, largest errors, the parts that were ever active and those that never were.
  void add(const AdvanceReport& later);
};

/// What a change of the fork did to the stored energy.
struct ChangeReport {
  double elastic_energy_before = 0.0;  ///< [J]
  double elastic_energy_after = 0.0;   ///< [J]
  std::string message;                 ///< one line for the user
};

/// A scene, the hands and their tools: puts together just the parts that the scene needs, and owns time.
/// No clock, no thread, no log, no ROS: the same calls give the same bits. NaN goes neither in nor out.
/// A hand is a number from 0 (the first stylus) to most_hands − 1; another one throws std::out_of_range.
class Simulation {
 public:
  static constexpr std::size_t most_hands = 2;

  /// Throws InputError when settings and scene do not fit (e.g. `grasp.object` is not in the scene).
  Simulation(const scene::Scene& scene, const SimulationSettings& settings);
  ~Simulation();
  Simulation(Simulation&&) noexcept;
  Simulation& operator=(Simulation&&) noexcept;

  const scene::Scene& scene() const;
  /// As given; `dynamics` as changed since, `fork` as calibrated to the world.
  const SimulationSettings& settings() const;
  /// The fork in a hand: as given, changed and calibrated since.
  const rod::ForkSettings& fork_settings(std::size_t hand = 0) const;

  /// Simulated time [s]: the first sample's stamp at first.
  double time() const;

  /// A new pose of the handle. Returns false when its stamp is not later than the newest one's (it is left out).
  /// Throws InputError when it is not finite.
  bool push_stylus(const motion::PoseSample& sample, std::size_t hand = 0);
  /// The grasp button goes down or up at time `t` [s]; takes effect at the first step that begins at or after `t`.
  void push_button(double t, bool pressed, std::size_t hand = 0);
  /// The second button of the stylus is pressed at time `t` [s]: the next of the tools, or, while something is held,
  /// the next that can hold it.
  void push_next_tool(double t, std::size_t hand = 0);
  /// Time of the newest sample of any hand, or time() where there is none.
  double newest_sample() const;
  /// The next time after time() at which a hand has a sample or a button an edge, or of the first sample; infinity
  /// where there is none. Where every call of `advance` ends at one of these, it is of no effect how many calls there
  /// are.
  double next_edge() const;

  /// Goes from time() to `t_end` in steps of at most `settings().dynamics.step` that end at the samples.
  AdvanceReport advance(double t_end);

  /// Objects back to their start, nothing held, no sample known: for a jump of time, or on request.
  void reset();
  /// These objects to where they are said to be, from rest, in all hands' stead: nothing is held. Names that the scene
  /// does not have are left out. Throws InputError when a pose is not finite.
  void place(const std::map<std::string, RigidTransform>& X_WO);
  /// Every hand lets go of what it holds. False when nothing was held.
  bool release();
  /// The same of one hand.
  bool release(std::size_t hand);

  // Changes while running; pose and twist of the object go on without a jump. One that cannot be made throws InputError
  // and changes nothing.
  /// Another tool in one hand. The object that it holds goes on; the new tool starts without strain. The probe cannot
  /// hold: with it the object is let go.
  ChangeReport select_tool(tools::Tool tool, std::size_t hand = 0);
  /// Of the fork in one hand, or in all.
  ChangeReport change(const ForkChange& change, std::optional<std::size_t> hand = std::nullopt);
  void change(const DynamicsChange& change);
  /// Both, or neither.
  void change(const ForkChange& of_fork, const DynamicsChange& of_dynamics);
  /// Stiffness from the mass and size of the held object, or of the world with `calibrate: world`, of the fork in each
  /// hand that holds one; the damping ratios stay. Throws InputError when nothing is held.
  ChangeReport calibrate();

  const std::vector<bodies::BodyState>& objects() const;
  tools::ToolState fork(std::size_t hand = 0) const;
  const std::vector<contact::ContactState>& contacts() const;

  /// The whole state: time, hands with their samples, buttons, tools and holds, objects, contacts and their warm
  /// starts, histories of integrators, and the settings that can be changed while running. Two saves of one state are
  /// equal.
  SimulationState save() const;
  /// Goes on from a saved state, bit by bit as the simulation that it is of, whatever has happened since. Throws
  /// InputError where that was of other objects, another contact mode or another shape of the fork, and for numbers
  /// that are no state; then nothing has changed.
  void restore(const SimulationState& state);
  /// The hash of save().
  std::uint64_t state_hash() const { return save().hash(); }

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace spring_workbench::simulation
