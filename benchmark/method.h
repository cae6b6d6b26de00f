#pragma once

#include <limits>
#include <memory>
#include <string>
#include <vector>

#include "benchmark/scenarios.h"

namespace spring_workbench::benchmark {

/// What one run of a method gives.
struct RunResult {
  std::vector<Vector3d> outputs;  ///< at output_times(scene): A and C centre of mass [m], B (0, 0, twist) [rad]
  double wall_seconds = std::numeric_limits<double>::infinity();  ///< of the stepping loop alone
  long steps_fallback = 0;  ///< of ours on samples: steps done by the rule that takes over from the integrator
  bool given_up = false;    ///< at the time limit
  bool finite = false;      ///< reached the end, finite and within 1000 m or rad
};

/// A way to simulate the scenes, behind which every peer and every integrator of ours stands.
class Method {
 public:
  enum class Knob { step, tolerance };

  virtual ~Method() = default;

  /// Name in reports, e.g. "bullet_explicit".
  virtual std::string name() const = 0;

  /// Whether it is one of this package's own.
  virtual bool ours() const { return false; }

  /// What `setting` of run() means: the largest step [s], or a relative tolerance.
  virtual Knob knob() const { return Knob::step; }

  /// Whether its own law is that of `Scenario` in this scene. Where it is not (its rotation is parametrised in another
  /// way), its error is taken against its own solution at a tiny step.
  virtual bool has_scene_law(const Scenario&) const { return true; }

  /// Whether its steps may be longer than the interval of the outputs, between which it is then interpolated. Ours end
  /// at them, as a user's end at samples.
  virtual bool takes_long_steps() const { return knob() == Knob::step && !ours(); }

  /// One run over the scene. A step divides the output interval, or is longer where takes_long_steps().
  virtual RunResult run(const Scenario& scene, double setting) const = 0;
};

using MethodPtr = std::unique_ptr<Method>;

/// How often a run is repeated: its wall time is the least of at least `runs` runs that take at least `seconds` in all,
/// but no more of them than fit into kMostSeconds.
struct Repetition {
  int runs = 1;
  double seconds = 0.0;  ///< [s]
};
constexpr double kMostSeconds = 0.5;

/// Whether another run is due after `runs` that took `spent` [s] in all.
bool wants_another(const Repetition& repetition, int runs, double spent);

/// run() in a child process: an engine that aborts, hangs or runs wild does not take the report along. Not finite when
/// the child died or took longer than `time_limit` [s]. The caller must have no other threads.
RunResult run_isolated(const Method& method, const Scenario& scene, double setting, const Repetition& repetition,
                       double time_limit);

/// Whether an output is finite and within 1000 m or rad.
bool is_bounded(const Vector3d& output);

}  // namespace spring_workbench::benchmark
