#pragma once

#include <bitset>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "spring_workbench/bodies/body_state.h"
#include "spring_workbench/contact/contact_state.h"
#include "spring_workbench/math/state_archive.h"
#include "spring_workbench/motion/stylus_source.h"
#include "spring_workbench/scene/scene.h"
#include "spring_workbench/simulation/settings.h"
#include "spring_workbench/tools/tool_state.h"

namespace spring_workbench::simulation {

/// The whole state of a simulation between two calls: everything that its future depends on, apart from its scene and
/// the settings it was made with. A value: a simulation of the same scene and settings that is restored from it
/// continues bit by bit like the one that was saved (`Simulation::save`, `Simulation::restore`).
class SimulationState {
 public:
  SimulationState() = default;  ///< empty: to be assigned to; `Simulation::restore` refuses it

  int styluses() const { return styluses_; }  ///< of the simulation that was saved; 0 if empty
  /// Returns the hash of all its numbers: equal states have equal hashes on every machine.
  std::uint64_t hash() const { return math::hash(words_); }
  bool operator==(const SimulationState& other) const { return origin_ == other.origin_ && words_ == other.words_; }
  bool operator!=(const SimulationState& other) const { return !(*this == other); }

 private:
  friend class Simulation;
  friend std::string serialise(const SimulationState& state);
  friend SimulationState parse_state(const std::string& text);

  std::string origin_;  ///< what a simulation restored from it must be made with, a line per property
  int styluses_ = 0;
  math::StateArchive::Words words_;
};

/// The state as YAML text, which another process can parse: every number with all its bits.
std::string serialise(const SimulationState& state);

/// Throws InputError if the text is no such state, or if its hash does not match its numbers.
SimulationState parse_state(const std::string& text);

/// A hash as 16 hexadecimal digits.
std::string to_hex(std::uint64_t hash);

/// What a call of `advance`, or a sequence of calls, did.
struct AdvanceReport {
  int steps = 0;                   ///< integrator steps taken
  double simulated_time = 0.0;     ///< [s]
  double position_error = 0.0;     ///< largest estimate of a step's local error [m]
  double angle_error = 0.0;        ///< largest estimate of a step's local error in angle [rad]
  double local_error_bound = 0.0;  ///< largest bound of a step's local error in position [m]; infinity: no bound
  double error_bound = 0.0;        ///< largest bound of the run's error in position [m] (doc/model.md, "Error bound")
  double angle_error_bound = 0.0;  ///< largest bound of the run's error in angle [rad]
  int steps_unbounded = 0;         ///< steps without an error bound
  double energy_added = 0.0;       ///< energy of the held object and the fork beyond the work of hand, gravity, damping
                                   ///< and contact [J]; meaningful if stiffest_omega_dt is below about 1
  double stiffest_omega_dt = 0.0;  ///< ω·dt of the stiffest mode
  int steps_among_movable = 0;     ///< steps near other movable objects (contact mode `dynamic`)
  int collision_queries = 0;
  int substeps = 0;  ///< discarded attempts, repeated with a shorter step (equation not solved, or error too large)
  int stops = 0;     ///< steps that met the end of the fork's range
  int steps_fallback = 0;     ///< steps taken by an L-stable rule because the integrator's equation was not solved
  double energy_error = 0.0;  ///< sum of the steps' estimated errors in energy [J]
  int steps_blocked = 0;      ///< steps in which no admissible motion of a body was found, so that it stayed
  int steps_unsolved = 0;     ///< steps near other movable objects that were taken although a contact missed its law by
                              ///< more than 1 µm, was deeper than 0.1 mm, or a free body may have gone too deep
  double time_lost = 0.0;     ///< time during which a body did not follow its equation [s]
  int steps_rejected = 0;     ///< steps rejected because the result was not finite or bounded
  int wrench_timeouts = 0;    ///< times an external wrench went to zero because no next one came in time
  std::bitset<8> ran;         ///< which subsystems ran, in the order of active()

  std::vector<std::string> active() const;   ///< names of the subsystems that ran
  std::vector<std::string> skipped() const;  ///< names of those that were not needed
  /// Adds a later report: sums, largest errors, the subsystems that ran in either.
  void add(const AdvanceReport& later);
};

/// Effect of a change of the fork on the stored energy.
struct ChangeReport {
  double elastic_energy_before = 0.0;  ///< [J]
  double elastic_energy_after = 0.0;   ///< [J]
  std::string message;                 ///< one line for the user
};

/// A scene, the hands and their tools, with only the subsystems that the scene needs. It owns simulated time. It uses
/// no clock, thread, log or ROS: the same calls give bit-identical results. NaN is neither accepted nor returned. A
/// hand is a number from 0 (the first stylus) to hands() − 1; any other throws InputError. All times are those of the
/// hand's clock. `settings().hand_time_scale` times as much time passes in the world, in which velocities and rates are
/// reported and whose steps `settings().dynamics.step` limits.
class Simulation {
 public:
  /// Throws InputError if settings and scene do not match (e.g. `grasp.object` is not in the scene).
  Simulation(const scene::Scene& scene, const SimulationSettings& settings);
  ~Simulation();
  Simulation(Simulation&&) noexcept;
  Simulation& operator=(Simulation&&) noexcept;

  /// The scene with all edits; objects are at their start poses.
  const scene::Scene& scene() const;
  /// The settings as given, with `dynamics` as changed since and `fork` as calibrated to the world.
  const SimulationSettings& settings() const;
  std::size_t hands() const;  ///< as many as `settings().styluses`
  /// The fork in a hand: as given, changed and calibrated since.
  const rod::ForkSettings& fork_settings(std::size_t hand = 0) const;

  /// Simulated time [s]; the stamp of the first sample until `advance` is called.
  double time() const;
  /// The same by the clock of the world [s].
  double world_time() const;

  /// Adds a pose of the stylus; its position is scaled by `settings().hand_scale`. Returns false, and ignores the pose,
  /// if its stamp is not later than the newest one. Throws InputError if the pose is invalid (motion::PoseTrack::push).
  bool push_stylus(const motion::PoseSample& sample, std::size_t hand = 0);
  /// Presses or releases a button at time `t` [s], finite; it acts at the first step that begins at or after `t`.
  void push_press(double t, motion::Press press, std::size_t hand = 0);
  /// The grasp button.
  void push_button(double t, bool pressed, std::size_t hand = 0) {
    push_press(t, pressed ? motion::Press::grasp : motion::Press::release, hand);
  }
  /// The second button: selects the next tool or, while something is held, the next tool that can hold it.
  void push_next_tool(double t, std::size_t hand = 0) { push_press(t, motion::Press::next_tool, hand); }
  /// The clutch. While it is on, the tool and what it holds stay where they are; when it goes off, they follow the
  /// hand's further motion from there.
  void push_clutch(double t, bool on, std::size_t hand = 0) {
    push_press(t, on ? motion::Press::clutch_on : motion::Press::clutch_off, hand);
  }
  /// Adds a wrench on the held object that a machine's force sensor has measured, in real units: it is multiplied by
  /// the scene's `force_scale`. It acts from its time on, or at once if it is late, until the next one or for
  /// `settings().wrench_timeout`. Throws InputError, and changes nothing, if it is invalid.
  void push_external_wrench(const motion::ExternalWrench& sample, std::size_t hand = 0);
  /// Time of the newest sample of any hand, or time() if there is none.
  double newest_sample() const;
  /// The next time [s] at which a hand has a sample, a button changes or an external wrench begins or ends; infinity
  /// if there is none. A simulation that is advanced from edge to edge gives the same result as one that is advanced
  /// over several edges in one call.
  double next_edge() const;

  /// Simulates from time() to `t_end` [s] in steps of at most `settings().dynamics.step` that end at the samples. If
  /// `t_end` is not later than time(), no time passes, but earlier buttons act. Throws InputError if it is not finite.
  AdvanceReport advance(double t_end);

  /// Puts all objects back to their start poses, releases them and forgets all samples.
  void reset();
  /// Places these objects at rest at the given poses; all hands release first. Throws InputError, and changes nothing,
  /// if a name is not that of a movable object or a pose is not finite.
  void place(const std::map<std::string, RigidTransform>& X_WO);
  /// Every hand releases its object. Returns false if nothing was held.
  bool release();
  bool release(std::size_t hand);  ///< the same for one hand

  // Changes while running; pose and twist of the object do not jump. A change that is impossible throws InputError and
  // changes nothing.
  /// Changes the tool in one hand or, with std::nullopt, in each. The hand keeps its object, and the new tool starts
  /// without strain; only the probe cannot hold, so the object is released.
  ChangeReport select_tool(tools::Tool tool, std::optional<std::size_t> hand = 0);
  /// Changes the fork in one hand or, with std::nullopt, in each.
  ChangeReport change(const ForkChange& change, std::optional<std::size_t> hand = std::nullopt);
  /// Changes integrator, step or tolerance of all hands. Throws InputError if a value is invalid.
  void change(const DynamicsChange& change);
  /// Makes both changes, or neither.
  void change(const ForkChange& of_fork, const DynamicsChange& of_dynamics);
  /// Adds, moves or removes an object, or changes its mass or friction; everything else continues from where it is.
  /// Added and moved objects start at rest and fall if nothing supports them; objects that lay on a moved or removed
  /// one fall. A removed object is released first. A moved object keeps its start pose, to which reset() returns it. A
  /// URDF is read from `roots` as by load_scene(), and again by restore(). Throws InputError also for a held object
  /// that is to be moved, and for an added or moved one that would overlap another body by more than 0.1 mm.
  ChangeReport edit(const ObjectEdit& edit, const std::vector<std::string>& roots = {});
  /// The scene as edited, with its objects where they are now.
  scene::Scene scene_now() const;
  /// Fits one tool, or with std::nullopt each, to the object that it holds; with `calibrate: world`, restores the
  /// scene's stiffness. The damping ratios stay. Throws InputError if no fork or spring holds an object.
  ChangeReport calibrate(std::optional<std::size_t> hand = std::nullopt);

  const std::vector<bodies::BodyState>& objects() const;       ///< the movable objects, in the scene's order
  const bodies::Changes& object_changes() const;               ///< of these
  tools::ToolState fork(std::size_t hand = 0) const;           ///< state of the tool in a hand, also if it is no fork
  const std::vector<contact::ContactState>& contacts() const;  ///< present ones, and those that ended in the last call

  /// The whole state: time, hands with their samples, buttons, tools and holds, objects, contacts and their warm
  /// starts, histories of integrators, the settings that can be changed while running, and what was edited. Two saves
  /// of one state are equal.
  SimulationState save() const;
  /// Restores a saved state, from which the future is bit-identical, whatever has happened since. Throws InputError,
  /// and changes nothing, if the state has other objects, another number of styluses, another contact mode or
  /// another shape of the fork, or is invalid.
  void restore(const SimulationState& state);
  /// The same as restore(other.save()), and quicker for one of the same scene, settings and edits.
  void follow(const Simulation& other);
  std::uint64_t state_hash() const { return save().hash(); }  ///< hash of save()

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace spring_workbench::simulation
