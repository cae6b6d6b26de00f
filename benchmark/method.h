#pragma once

#include <algorithm>
#include <functional>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include "benchmark/scenarios.h"
#include "spring_workbench/math/state_archive.h"

namespace spring_workbench::benchmark {

/// Result of one run of a method.
struct RunResult {
  std::vector<Vector3d> outputs;  ///< at output_times(scene): A and C centre of mass [m], B (0, 0, twist) [rad]
  double wall_seconds = std::numeric_limits<double>::infinity();  ///< time of the stepping loop alone
  long steps_fallback = 0;  ///< for our integrators on samples: steps taken by the fallback rule
  bool given_up = false;    ///< whether the run exceeded the time limit
  bool finite = false;      ///< whether it reached the end, finite and within 1000 m or rad

  void archive(math::StateArchive& state) { state(outputs, wall_seconds, steps_fallback, given_up, finite); }
};

/// Interface of a method that simulates the scenes: a baseline or one of our integrators.
class Method {
 public:
  enum class Knob { step, tolerance };

  virtual ~Method() = default;

  /// Name in reports, e.g. "bullet_explicit".
  virtual std::string name() const = 0;

  /// Whether it is one of this package's integrators.
  virtual bool ours() const { return false; }

  /// Meaning of the `setting` of run(): the largest step [s] or a relative tolerance.
  virtual Knob knob() const { return Knob::step; }

  /// Whether its force law is that of `Scenario` in this scene. If not (because it parametrises rotation differently),
  /// its error is measured against its own solution at a tiny step.
  virtual bool has_scene_law(const Scenario&) const { return true; }

  /// Whether it is to be run on this scene.
  virtual bool runs_on(const Scenario&) const { return true; }

  /// Whether its steps may be longer than the output interval, with interpolation between them. Our steps end at the
  /// outputs, as they end at samples for a user.
  virtual bool takes_long_steps() const { return knob() == Knob::step && !ours(); }

  /// Runs the scene once. The step divides the output interval, or may be longer if takes_long_steps().
  virtual RunResult run(const Scenario& scene, double setting) const = 0;
};

using MethodPtr = std::unique_ptr<Method>;

/// How often a run is repeated: its wall time is the minimum over at least `runs` runs that take at least `seconds` in
/// total, but no more than fit into kMaxSeconds.
struct Repetition {
  int runs = 1;
  double seconds = 0.0;  ///< [s]
  bool warm = false;     ///< whether a similar run was made before in the same process
};
constexpr double kMaxSeconds = 0.05;

/// Whether another run is due after `runs` runs that took `spent` [s] in total.
bool wants_another(const Repetition& repetition, int runs, double spent);

/// The first result of `run`, with the shortest of the `wall_seconds` of these repetitions. If several runs are asked
/// for and none was made before, a first one that takes less than kColdSeconds does not count: its memory and caches
/// are cold.
constexpr double kColdSeconds = 0.02;
template <typename Run>
auto fastest(const Repetition& repetition, Run&& run) {
  auto best = run();
  int runs = 1;
  double spent = best.wall_seconds;
  if (repetition.runs > 1 && !repetition.warm && spent < kColdSeconds) {
    runs = 0;
    spent = 0.0;
    best.wall_seconds = std::numeric_limits<double>::infinity();
  }
  for (; best.finite && wants_another(repetition, runs, spent); ++runs) {
    const double again = run().wall_seconds;
    spent += again;
    best.wall_seconds = std::min(best.wall_seconds, again);
  }
  return best;
}

/// results_of_child(), none of them finite if the child died or took longer than `time_limit` [s] for each function.
std::vector<RunResult> run_isolated(const std::vector<std::function<RunResult()>>& runs, double time_limit);

/// The fastest of repeated runs, in a child process.
RunResult run_isolated(const Method& method, const Scenario& scene, double setting, const Repetition& repetition,
                       double time_limit);

/// Whether an output is finite and within 1000 m or rad.
bool is_bounded(const Vector3d& output);

}  // namespace spring_workbench::benchmark
