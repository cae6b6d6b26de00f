#pragma once

#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "spring_workbench/assembly/placement.h"
#include "spring_workbench/assembly/task_score.h"
#include "spring_workbench/simulation/simulation.h"

namespace spring_workbench::assembly {

/// Observes an assembly without changing it: which objects are in place, and the score of all hands together.
class TaskMonitor {
 public:
  /// Judges by the targets of `scene`; one without targets has no task, and `observe` does nothing.
  explicit TaskMonitor(const scene::Scene& scene);

  /// Call after each `advance`: it compares the states of two successive calls.
  void observe(const simulation::Simulation& simulation);
  /// From the start again.
  void reset();

  /// One per target, in the order of their names.
  const std::vector<Placement>& placements() const { return placements_; }
  const TaskScore& score() const { return score_; }

 private:
  struct Watched {
    scene::Body body;
    scene::Target target;
  };
  /// State of a hand at the last call.
  struct Hand {
    std::optional<Vector3d> p;  ///< none: no sample yet
    std::string held;           ///< empty: nothing
  };
  /// State of an object that one or several hands hold.
  struct Carried {
    Vector3d p = Vector3d::Zero();             ///< at the last call
    double since = 0.0;                        ///< [s]
    std::map<std::string, double> last_touch;  ///< by the other's name [s]
  };

  void judge(const std::vector<bodies::BodyState>& objects);
  void add_path_lengths(const simulation::Simulation& simulation);
  void note_holds(const simulation::Simulation& simulation);
  void note_contacts(double t, const std::vector<contact::ContactState>& contacts);
  void note_force(const std::string& object, double force);
  void note_drops(const std::vector<bodies::BodyState>& objects);
  bool is_fixed(const std::string& name) const;

  std::vector<std::string> movable_;
  std::vector<Watched> watched_;
  std::vector<Placement> placements_;
  TaskScore score_;
  bool started_ = false;
  double begin_ = 0.0;
  std::vector<Hand> hands_;
  std::map<std::string, Carried> carried_;
  std::set<std::string> broken_;
  std::map<std::string, double> released_height_;  ///< of objects that may be falling [m]
};

}  // namespace spring_workbench::assembly
