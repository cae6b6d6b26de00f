#pragma once

#include <bitset>
#include <cstdint>
#include <functional>
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
/// the settings it was made with. A simulation of the same scene and settings that is restored from it has a
/// bit-identical future to the one that was saved (`Simulation::save`, `Simulation::restore`).
class SimulationState {
 public:
  SimulationState() = default;  ///< an empty state, which `Simulation::restore` refuses

  int styluses() const { return styluses_; }  ///< number of styluses of the simulation that was saved; 0 if empty
  /// Returns a hash of all its numbers; equal states have equal hashes on every machine.
  std::uint64_t hash() const { return math::hash(words_); }
  bool operator==(const SimulationState& other) const { return origin_ == other.origin_ && words_ == other.words_; }
  bool operator!=(const SimulationState& other) const { return !(*this == other); }

 private:
  friend class Simulation;
  std::vector<ObjectEdit> edits() const;  ///< throws InputError if there are none
  friend std::string serialise(const SimulationState& state);
  friend SimulationState parse_state(const std::string& text);

  std::string origin_;  ///< properties that a simulation to be restored from it must share, one per line
  int styluses_ = 0;
  math::StateArchive::Words words_;
};

/// The state as YAML text for another process, with all bits of every number.
std::string serialise(const SimulationState& state);

/// Reads the text of serialise(). Throws InputError if it is not such a state, or if its hash does not match its
/// numbers.
SimulationState parse_state(const std::string& text);

/// A hash as 16 hexadecimal digits.
std::string to_hex(std::uint64_t hash);

/// Report on a call of `advance` or a sequence of calls.
struct AdvanceReport {
  std::int64_t steps = 0;       ///< integrator steps taken
  double simulated_time = 0.0;  ///< [s]
  double position_error = 0.0;  ///< largest estimate of a step's local error [m]
  double angle_error = 0.0;     ///< largest estimate of a step's local error in angle [rad]
  // Bounds over the steps that have one (doc/model.md, "Error bound"); none without the setting `error_bound`.
  std::optional<double> local_error_bound;  ///< largest bound on a step's local error in position [m]
  std::optional<double> error_bound;  ///< of the error in position since the grasp or the last step without one [m]
  std::optional<double> angle_error_bound;  ///< the same in angle [rad]
  int steps_unbounded = 0;                  ///< integrations (in contact several a step) without a bound
  double energy_balance = 0.0;     ///< energy of the held object and the fork beyond the work of hand, gravity, damping
                                   ///< and contact [J]; meaningful if stiffest_omega_dt is below about 1
  double stiffest_omega_dt = 0.0;  ///< ω·dt of the stiffest mode
  int steps_among_movable = 0;     ///< steps near other movable objects (contact mode `dynamic`)
  std::int64_t collision_queries = 0;  ///< queries to the collision library
  std::int64_t substeps = 0;  ///< steps discarded and repeated as shorter ones: equation not solved, or error too large
  int stops = 0;              ///< steps that met the end of the fork's range
  int steps_fallback = 0;     ///< integrations by an L-stable rule, since the integrator's own equation was not solved
  double energy_error = 0.0;  ///< sum of the steps' estimated errors in energy [J]
  int steps_blocked = 0;      ///< steps in which no admissible motion of a body was found, so that it stayed
  int steps_unsolved = 0;     ///< (parts of) steps in which a contact among movable objects missed its law by 1 µm
  double time_lost = 0.0;     ///< time during which a body did not follow its equation [s]
  int steps_rejected = 0;     ///< steps rejected because the result was not finite or bounded
  int wrench_timeouts = 0;    ///< times an external wrench went to zero because no next one came in time
  std::bitset<8> ran;         ///< the subsystems that ran, in the order of active()

  std::vector<std::string> active() const;   ///< names of the subsystems that ran
  std::vector<std::string> skipped() const;  ///< names of the subsystems that were not needed
  /// Adds a later report: sums of counts and times, maxima of errors, union of the subsystems that ran.
  void add(const AdvanceReport& later);
};

/// Effect of a change on the energy.
struct ChangeReport {
  double elastic_energy_before = 0.0;  ///< stored in the tools just before the change [J]
  double elastic_energy_after = 0.0;   ///< and just after it [J]
  double energy_added = 0.0;           ///< what the change adds to Simulation::energy() [J]
  std::string message;                 ///< one line for the user
};

/// Simulates a scene with hands and their tools, and runs only the subsystems that the scene needs. It owns simulated
/// time. It uses no clock, thread, log or ROS: the same calls give bit-identical results. NaN is neither accepted nor
/// returned. Hands are numbered from 0 (the first stylus) to hands() − 1; any other number throws InputError. All times
/// are those of the hand's clock. World time runs `settings().hand_time_scale` times as fast; velocities, rates and the
/// limit `settings().dynamics.step` refer to world time.
class Simulation {
 public:
  /// Throws InputError if settings and scene do not match (e.g. if `grasp.object` is not in the scene).
  Simulation(const scene::Scene& scene, const SimulationSettings& settings);
  ~Simulation();
  Simulation(Simulation&&) noexcept;
  Simulation& operator=(Simulation&&) noexcept;

  /// The scene with all edits; objects are at their start poses.
  const scene::Scene& scene() const;
  /// The settings as given, with `dynamics` as changed since and `fork` as calibrated to the world.
  const SimulationSettings& settings() const;
  std::size_t hands() const;  ///< number of hands, `settings().styluses`
  /// The fork in a hand, with all changes and calibrations since the start.
  const rod::ForkSettings& fork_settings(std::size_t hand = 0) const;

  /// Simulated time [s]: at first the first sample's stamp, or the `t_end` of the first `advance` if that is earlier.
  double time() const;
  /// Simulated time in world time [s].
  double world_time() const;

  /// Adds a pose of the stylus, unfiltered; its position is scaled by `settings().hand_scale`. Returns false if its
  /// stamp is not later than the newest one. Throws InputError if the pose is invalid (motion::PoseTrack::push).
  bool push_stylus(const motion::PoseSample& sample, std::size_t hand = 0);
  /// Presses or releases a button at the finite time `t` [s]; it acts at the first step that begins at or after `t`.
  void push_edge(double t, motion::ButtonEdge press, std::size_t hand = 0);
  /// Presses or releases the grasp button.
  void push_button(double t, bool pressed, std::size_t hand = 0) {
    push_edge(t, pressed ? motion::ButtonEdge::grasp : motion::ButtonEdge::release, hand);
  }
  /// Presses the second button, which selects the next tool or, while something is held, the next tool that can hold
  /// it.
  void push_next_tool(double t, std::size_t hand = 0) { push_edge(t, motion::ButtonEdge::next_tool, hand); }
  /// Switches the clutch. While it is on, the tool and what it holds stay in place; when it is switched off, they
  /// follow the hand's further motion from there.
  void push_clutch(double t, bool on, std::size_t hand = 0) {
    push_edge(t, on ? motion::ButtonEdge::clutch_on : motion::ButtonEdge::clutch_off, hand);
  }
  /// Adds a wrench on the held object that was measured by a machine's force sensor, in real units; it is multiplied by
  /// the scene's `force_scale`. It acts from its time (at once if that has passed) until the next wrench, but at most
  /// for `settings().wrench_timeout`. Throws InputError, and changes nothing, if it is invalid.
  void push_external_wrench(const motion::ExternalWrench& sample, std::size_t hand = 0);
  /// Time of the newest sample of any hand, or time() if there is none.
  double newest_sample() const;
  /// The next time [s] at which a hand has a sample, a button changes or an external wrench begins or ends; infinity
  /// if there is none. A simulation that is advanced from edge to edge gives the same result as one that is advanced
  /// over several edges in one call.
  double next_edge() const;

  /// Simulates from time() to `t_end` [s] in steps of at most `settings().dynamics.step`; steps also end at each
  /// sample. If `t_end` is not later than time(), no time passes, but pending buttons act. Throws InputError if it is
  /// not finite.
  AdvanceReport advance(double t_end);

  /// Releases all objects, returns them to their start poses and forgets all samples.
  void reset();
  /// Places these objects at rest at the given poses; all hands release first. Throws InputError, and changes nothing,
  /// if a name is not that of a movable object or a pose is not finite.
  void place(const std::map<std::string, RigidTransform>& X_WO);
  /// One hand or, with std::nullopt, each releases its object. Returns false if nothing was held.
  bool release(std::optional<std::size_t> hand = std::nullopt);

  // Changes while running. The pose and twist of the object do not jump. An impossible change throws InputError and
  // changes nothing.
  /// Changes the tool in one hand or, with std::nullopt, in each. The hand keeps its object, and the new tool starts
  /// without strain; the probe cannot hold an object, so it is released.
  ChangeReport select_tool(tools::Tool tool, std::optional<std::size_t> hand = 0);
  /// Changes the fork in one hand or, with std::nullopt, in each, and integrator, step or tolerance of all hands.
  ChangeReport change(const ForkChange& fork, const DynamicsChange& dynamics,
                      std::optional<std::size_t> hand = std::nullopt);
  ChangeReport change(const ForkChange& fork, std::optional<std::size_t> hand = std::nullopt) {
    return change(fork, {}, hand);
  }
  ChangeReport change(const DynamicsChange& dynamics) { return change({}, dynamics); }
  /// Adds, moves or removes an object, or changes its mass or friction; the state of everything else is kept. Added and
  /// moved objects start at rest and fall if nothing supports them; objects that lay on a moved or removed one fall. A
  /// removed object is released first. A moved object keeps its start pose, to which reset() returns it. The URDF of an
  /// added object is read from `roots` as in load_scene(), and again by restore(). Also throws InputError if a held
  /// object is to be moved, or if an added or moved object would overlap another body by more than 0.1 mm.
  ChangeReport edit(const ObjectEdit& edit, const std::vector<std::string>& roots = {}) {
    std::optional<Simulation> next = edited(edit, roots);
    return this->edit(edit, next);
  }
  /// Likewise, in little time. `next`: from edited(edit); afterwards it is the simulation as it was before.
  ChangeReport edit(const ObjectEdit& edit, std::optional<Simulation>& next);
  /// The edited scene as a simulation at its start; nothing if edit() needs no other. This takes long, but depends only
  /// on what advance() does not change: another thread may advance this simulation meanwhile. Throws as edit().
  std::optional<Simulation> edited(const ObjectEdit& edit, const std::vector<std::string>& roots = {}) const;
  /// Likewise for restore() and go_back_to(): the scene with the edits of `state`. Throws as restore().
  std::optional<Simulation> edited(const SimulationState& state) const;
  /// Calibrates one tool, or with std::nullopt each, to the object that it holds; with `calibrate: world`, restores the
  /// scene's stiffness. Damping ratios are not changed. Throws InputError if no fork or spring holds an object.
  ChangeReport calibrate(std::optional<std::size_t> hand = std::nullopt);

  const std::vector<bodies::BodyState>& objects() const;  ///< the movable objects, in the scene's order
  const bodies::Changes& object_changes() const;          ///< changes of the states in objects()
  tools::ToolState tool(std::size_t hand = 0) const;      ///< state of the tool in a hand
  double elastic_energy() const;                          ///< stored in all tools [J]
  /// elastic_energy(), and kinetic and potential energy of the objects (zero at z = 0) [J]; without what is stored in
  /// compliant materials.
  double energy() const;
  /// The current contacts, and those that ended in the last call of advance().
  const std::vector<contact::ContactState>& contacts() const;

  /// Saves the whole state: time, hands with their samples, buttons, tools and holds, objects, contacts and their warm
  /// starts, histories of integrators, the settings that can be changed while running, and the edits. Two saves of one
  /// state are equal.
  SimulationState save() const;
  /// Restores a saved state; the future is then bit-identical, whatever has happened in between. Throws InputError, and
  /// changes nothing, if the state is invalid or has different objects, a different number of styluses, or a different
  /// contact mode or fork shape.
  void restore(const SimulationState& state);
  /// Goes back to edits, settings, tools and objects of an earlier state; time and the hands' input (samples, buttons,
  /// clutch) continue, nothing is held, and the objects are at rest. `next`: as in edit(), but gone back to `state`.
  void go_back_to(const SimulationState& state, std::optional<Simulation>& next);
  /// Equivalent to restore(other.save()), but faster if scene, settings and edits are the same.
  void follow(const Simulation& other);
  std::uint64_t state_hash() const { return save().hash(); }  ///< hash of save()

 private:
  struct Impl;
  explicit Simulation(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

/// Makes a change of the simulation and reports the energy before and after it; `change` returns the message.
ChangeReport reported(const Simulation& simulation, const std::function<std::string()>& change);

}  // namespace spring_workbench::simulation
