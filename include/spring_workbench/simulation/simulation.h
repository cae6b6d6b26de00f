#pragma once

#include <bitset>
#include <cstdint>
#include <functional>
#include <limits>
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
/// the settings that it was made with. A simulation of the same scene and settings that is restored from it continues
/// bit-identically (`Simulation::save`, `Simulation::restore`).
class SimulationState {
 public:
  SimulationState() = default;  ///< an empty state, which `Simulation::restore` refuses

  int hands() const { return styluses_; }  ///< number of hands of the simulation that was saved; 0 if empty
  std::uint64_t hash() const { return math::hash(words_); }  ///< equal for equal states, on every machine
  /// Whether two states are bit-identical and from simulations of the same kind.
  bool operator==(const SimulationState& other) const { return origin_ == other.origin_ && words_ == other.words_; }
  bool operator!=(const SimulationState& other) const { return !(*this == other); }  ///< whether they differ

 private:
  friend class Simulation;
  std::vector<ObjectEdit> edits() const;  ///< throws InputError if there are none
  friend std::string serialise(const SimulationState& state);
  friend SimulationState parse_state(const std::string& text);

  std::string origin_;  ///< properties that a simulation to be restored from it must share, one per line
  int styluses_ = 0;
  math::StateArchive::Words words_;
};

/// Returns the state as YAML text, for a file or another process. The text keeps all bits of every number.
std::string serialise(const SimulationState& state);

/// Reads a state from the text of serialise(). Throws InputError if the text is not a state or its hash does not match.
SimulationState parse_state(const std::string& text);

/// Report on one call of Simulation::advance_to(), or on several calls whose reports were added by add().
///
/// A step whose equation is not solved or whose error is too large (in position if there is a tolerance, otherwise in
/// energy) is discarded and repeated as shorter ones (`substeps`). If that does not help, or the integrator is unstable
/// at high stiffness, an L-stable rule takes it (`steps_fallback`). If that fails, too, the fork is rigid for the step
/// or, in contact, the object stays (`steps_rejected`; doc/model.md, "Steps that are not solved"). If these three
/// counters, `stops`, `steps_blocked`, `steps_unsolved` and `time_lost` are 0, nothing unusual happened.
///
/// An error is the result minus the exact solution of the equation of motion. An error bound is an empirical
/// upper estimate, not a rigorous bound (doc/model.md, "Error bound").
struct AdvanceReport {
  /// @name Steps and contact
  /// @{
  std::int64_t steps = 0;       ///< steps that were taken
  double simulated_time = 0.0;  ///< time that was simulated [s]
  std::int64_t substeps = 0;    ///< attempts at a step that were discarded and repeated as shorter steps
  int steps_fallback = 0;       ///< integrations by the L-stable rule, in place of the integrator
  int steps_rejected = 0;       ///< steps without a usable result (non-finite or out of range)
  int stops = 0;          ///< steps in which the fork reached the end of its range; unrelated to contact mode `stop`
  int steps_blocked = 0;  ///< steps in which no admissible motion of an object was found, so that it stayed in place
  /// Steps, or parts of one, that were accepted although a contact among movable objects was left with a residual above
  /// 1 µm, was deeper than 0.1 mm, or was lost.
  int steps_unsolved = 0;
  int steps_among_movable = 0;         ///< steps near other movable objects (contact mode `dynamic`)
  std::int64_t collision_queries = 0;  ///< queries to the collision library
  double time_lost = 0.0;              ///< time during which an object did not follow its equation of motion [s]
  double stiffest_omega_dt = 0.0;      ///< largest product of the stiffest mode's angular frequency and the step
  int wrench_timeouts = 0;             ///< external wrenches that ended because the next one did not come in time
  /// @}
  /// @name Errors
  /// @{
  double position_error = 0.0;              ///< largest estimate of a step's local error in position [m]
  double angle_error = 0.0;                 ///< largest estimate of a step's local error in angle [rad]
  std::optional<double> local_error_bound;  ///< largest bound of a step's local error in position [m]; empty: unknown
  /// Largest bound of an object's error in position [m], accumulated since the grasp or since the last step without a
  /// bound; empty if no step has a bound, e.g. because the setting `error_bound` is off.
  std::optional<double> error_bound;
  std::optional<double> angle_error_bound;  ///< largest bound of an object's error in angle [rad]; see `error_bound`
  int integrations_without_bound = 0;       ///< integrations that have no error bound
  double energy_error = 0.0;                ///< sum of the steps' estimated errors in energy [J]
  /// Energy created (> 0) or lost (< 0) by the integration itself [J]: the change in the energy of object and fork less
  /// the work of hand, gravity, damping and contact. Meaningful if `stiffest_omega_dt` is below about 1.
  double energy_balance = 0.0;
  /// @}
  std::bitset<8> ran;  ///< internal: the subsystems that ran, as bits; use active() and skipped()

  std::vector<std::string> active() const;   ///< names of the subsystems that ran
  std::vector<std::string> skipped() const;  ///< names of the subsystems that the scene did not need
  /// Adds a later report: sums counts, times and energies, and keeps the largest error of each kind.
  void add(const AdvanceReport& later);
};

/// Report on a change to a running simulation: its effect on the energy.
struct ChangeReport {
  double elastic_energy_before = 0.0;  ///< energy stored in all tools just before the change [J]
  double elastic_energy_after = 0.0;   ///< energy stored in all tools just after the change [J]
  double energy_added = 0.0;           ///< increase of Simulation::energy() by the change [J]
  std::string message;                 ///< description of the change for the user, in one line
};

/// Simulates a scene with hands and their tools, and runs only the subsystems that the scene needs.
///
///     simulation::Simulation sim(scene::load_scene("box.urdf"), {});
///     for (double t : {0.0, 0.5, 1.0}) {  // the hand moves up; the fork points down, into the box
///       sim.push_stylus({t, make_transform({0.0, 0.0, 0.24 + 0.1 * t}, Quaterniond(0.0, 1.0, 0.0, 0.0))});
///     }
///     sim.push_button(0.0, true);  // grasp
///     sim.advance_to(1.0);
///     std::cout << sim.objects()[0].X_WO.translation().transpose() << " m\n";
///
/// - Frames: world W, stylus S, handle H, tip E, object O at its centre of mass. z of S and H points along the fork,
///   from the hand to the tip. Poses and velocities are in W unless the name says otherwise.
/// - Hands are numbered from 0 to hands() − 1 (the nodes count from 1); another number throws InputError. To hold an
///   object without a button, set `grasp.object`. To begin without a hand, place() objects in the air and advance_to().
/// - Order: before you advance to a time, push everything that happens up to it. Poses, buttons and wrenches may come
///   in any order relative to each other, but the poses of one hand, and its wrenches, in the order of their times.
/// - Time: the simulation owns its time and reads no clock. On processors of one kind (with or without AVX and FMA)
///   the same calls give bit-identical results, never NaN. All times are on the hand's clock; its origin is arbitrary.
///   Velocities, rates and the setting `step` are in world time, which runs `settings().hand_time_scale` times as fast.
/// - Lifetimes: the scene is copied. References from const members are valid until the next call of a non-const one. A
///   simulation can be moved; to copy it, construct one from the same scene and settings, then copy_state_from().
/// - Threads: not thread-safe, not even among const members, apart from prepare_edit() and prepare_rewind(). Separate
///   simulations are independent.
class Simulation {
 public:
  /// Starts a simulation. Throws InputError if settings and scene do not match (e.g. no `grasp.object` in the scene).
  Simulation(const scene::Scene& scene, const SimulationSettings& settings);
  ~Simulation();
  Simulation(Simulation&&) noexcept;             ///< the other can then only be destroyed or assigned to
  Simulation& operator=(Simulation&&) noexcept;  ///< the other can then only be destroyed or assigned to

  const scene::Scene& scene() const;  ///< the scene with all edits; its objects are at their start poses
  /// The settings as given, but `dynamics` as set by change(), and `fork` as calibrated if `calibrate` is `world`.
  const SimulationSettings& settings() const;
  std::size_t hands() const;                                           ///< number of hands, `settings().styluses`
  const rod::ForkSettings& fork_settings(std::size_t hand = 0) const;  ///< the fork in a hand, with all changes so far
  /// Simulated time [s]. It begins at the first sample's stamp, or at the first `t_end` of advance_to() if earlier.
  double time() const;
  double world_time() const;  ///< simulated time in world time [s]

  /// Adds a pose X_WS of the stylus [m] at time `sample.t` [s]. It is not filtered; its position is multiplied by
  /// `settings().hand_scale`. The hand moves smoothly between samples and rests after the last one. If the gap between
  /// two samples is longer than `settings().dropout_after` (0.5 s), the hand stays at the first until the time of the
  /// second, and then jumps to it. A sample before time() changes the hand's motion from time() on. Returns false, and
  /// ignores the sample, if it is not later than the newest one. Throws InputError if the pose is not finite, not rigid
  /// or out of range (motion::PoseTrack::push).
  bool push_stylus(const motion::PoseSample& sample, std::size_t hand = 0);
  /// Adds a button edge for the first step that begins at or after `t` [s]. Throws InputError if `t` is not finite.
  void push_edge(double t, motion::ButtonEdge edge, std::size_t hand = 0);
  /// Presses or releases the grasp button at time `t` [s].
  void push_button(double t, bool pressed, std::size_t hand = 0) {
    push_edge(t, pressed ? motion::ButtonEdge::grasp : motion::ButtonEdge::release, hand);
  }
  /// Selects the next tool at time `t` [s] or, while something is held, the next tool that can hold it.
  void push_next_tool(double t, std::size_t hand = 0) { push_edge(t, motion::ButtonEdge::next_tool, hand); }
  /// Switches the clutch at time `t` [s]. While it is on, the tool and its object stay in place. Once it is off, they
  /// follow the hand's further motion from there.
  void push_clutch(double t, bool on, std::size_t hand = 0) {
    push_edge(t, on ? motion::ButtonEdge::clutch_on : motion::ButtonEdge::clutch_off, hand);
  }
  /// Applies a wrench, as a machine's force sensor measured it, to the held object at the tip. It is in real units, and
  /// is multiplied by the scene's `force_scale`. It acts from its time (at once if that has passed) until the next
  /// wrench, but at most for `settings().external_wrench_timeout`. It replaces pending wrenches of its own or a later
  /// time. Throws InputError, and changes nothing, if it is invalid.
  void push_external_wrench(const motion::ExternalWrench& sample, std::size_t hand = 0);
  double newest_sample_time() const;  ///< time of the newest sample of any hand, or time() if there is none [s]
  /// The next time [s] at which a hand has a sample or, once time has begun, a button changes or an external wrench
  /// begins or ends; infinity if there is none. Advancing to each in turn or past several at once gives the same
  /// result.
  double next_event_time() const;

  /// Simulates from time() to `t_end` [s] in steps of at most `settings().dynamics.step`; a step also ends at each
  /// sample, button edge and change of a wrench. Returns early after the step that reaches the simulated time
  /// `pause_at` [s]; call again with the same `t_end` to continue: the steps are the same as without a pause. If
  /// `t_end` is not later than time(), only pending buttons act. Throws InputError if `t_end` is not finite.
  AdvanceReport advance_to(double t_end, double pause_at = std::numeric_limits<double>::infinity());

  void reset();  ///< releases all objects, returns them to their start and forgets all samples; time starts again
  /// Releases all objects and places the named ones at rest at these poses; unsupported ones then fall. Throws
  /// InputError, and changes nothing, if no movable object has such a name or a pose is not finite.
  void place(const std::map<std::string, RigidTransform>& X_WO);
  /// Releases the object of one hand or, with std::nullopt, of every hand. Returns false if nothing was held.
  bool release(std::optional<std::size_t> hand = std::nullopt);

  /// @name Changes while running. No held object's pose jumps; nor does its twist, unless the new tool cannot follow.
  /// @{
  /// Changes the tool in one hand or, with std::nullopt, in every hand. The hand keeps its object, and the new tool
  /// starts without strain. The probe cannot hold an object, so a change to it releases the object.
  ChangeReport select_tool(tools::Tool tool, std::optional<std::size_t> hand = std::nullopt);
  /// Changes the fork in one hand or, with std::nullopt, in every hand. `dynamics` is changed for all hands, whatever
  /// `hand` is. `change(fork, {}, 0)`: only hand 0. Throws InputError, and changes nothing, if a value is not allowed.
  ChangeReport change(const ForkChange& fork, const DynamicsChange& dynamics = {},
                      std::optional<std::size_t> hand = std::nullopt);
  /// Calibrates the tool of one hand or, with std::nullopt, of every hand to the object that it holds. With
  /// `calibrate: world` it restores the scene's stiffness instead. Damping ratios are not changed; three equal ones of
  /// the law per_dof become one of the law modal. Throws InputError if no fork or spring holds an object.
  ChangeReport calibrate(std::optional<std::size_t> hand = std::nullopt);
  /// Adds, moves or removes an object, or changes its mass or friction; the state of everything else is kept. Added and
  /// moved objects start at rest and fall if nothing supports them; objects that lay on a moved or removed one fall. A
  /// removed object is released first. A moved object keeps its start pose, to which reset() returns it. The URDF of an
  /// added object is read from `roots` as in load_scene(), and again by restore(). Throws InputError, and
  /// changes nothing, if a value is not allowed, a held object is to be moved, or bodies would overlap by over 0.1 mm.
  ChangeReport edit(const ObjectEdit& edit, const std::vector<std::string>& roots = {}) {
    std::optional<Simulation> prepared = prepare_edit(edit, roots);
    return apply_edit(edit, prepared);
  }
  /// @}
  /// @name Edits in two phases, for real-time threads
  /// @{
  /// First phase of edit(): builds the edited scene as a new simulation, or returns nothing if none is needed. Slow,
  /// but another thread may call advance_to() meanwhile. Throws InputError like edit().
  std::optional<Simulation> prepare_edit(const ObjectEdit& edit, const std::vector<std::string>& roots = {}) const;
  /// Second phase of edit(), fast: swaps in `prepared`, the result of prepare_edit(). Afterwards `prepared` holds the
  /// former simulation, which any thread may destroy. Throws InputError like edit().
  ChangeReport apply_edit(const ObjectEdit& edit, std::optional<Simulation>& prepared);
  /// First phase of rewind_to(). Slow, but another thread may call advance_to() meanwhile. Throws like restore().
  std::optional<Simulation> prepare_rewind(const SimulationState& state) const;
  /// Second phase, fast: restores edits, settings, tools and objects of an earlier state. Time and the hands' input
  /// (samples, buttons, clutch) continue, nothing is held, and the objects are at rest. `prepared`: see apply_edit().
  void rewind_to(const SimulationState& state, std::optional<Simulation>& prepared);
  /// @}

  const std::vector<bodies::BodyState>& objects() const;  ///< states of the movable objects, in the scene's order
  const bodies::ChangeLog& object_changes() const;        ///< record of the changes in objects()
  tools::ToolState tool(std::size_t hand = 0) const;      ///< state of the tool in a hand
  double elastic_energy() const;                          ///< energy stored in all tools [J]
  /// Sum of elastic_energy() and the kinetic and potential energy of the objects (zero at z = 0) [J]. It excludes the
  /// energy stored in compliant materials.
  double energy() const;
  /// The present contacts, and the contacts that ended in the last advance_to().
  const std::vector<contact::ContactState>& contacts() const;

  /// Saves the whole state: time, hands with their input and tools, objects, contacts, histories of integrators, edits,
  /// and the settings that can be changed while running. Two saves of one state are equal.
  SimulationState save() const;
  /// Continues bit-identically from a state that was saved with the same scene and settings. Only bodies' names,
  /// number of styluses, contact mode and shape are compared; if they differ, throws InputError and changes nothing.
  void restore(const SimulationState& state);
  /// Equivalent to restore(other.save()), but faster if scene, settings and edits are the same.
  void copy_state_from(const Simulation& other);
  std::uint64_t state_hash() const { return save().hash(); }  ///< hash of save()

 private:
  struct Impl;
  explicit Simulation(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

/// Internal: runs `change`, which returns a message for the user. Reports the message and the change of energy.
ChangeReport with_energy_report(const Simulation& simulation, const std::function<std::string()>& change);

}  // namespace spring_workbench::simulation
