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

/// Observes an assembly without affecting it: which objects are in place, and the total score of all hands.
class TaskMonitor {
 public:
  /// Uses the targets of `scene`. Without targets there is no task, and `observe` does nothing.
  explicit TaskMonitor(const scene::Scene& scene);

  /// Call after each Simulation::advance_to(): it compares the states of two successive calls.
  void observe(const simulation::Simulation& simulation);
  /// Starts the task again.
  void reset();

  /// One per target, sorted by name.
  const std::vector<Placement>& placements() const { return placements_; }
  const TaskScore& score() const { return score_; }

 private:
  struct Watched {
    scene::Body body;
    scene::Target target;
  };
  /// State of a hand at the last call.
  struct Hand {
    std::optional<Vector3d> p;  ///< position of the handle [m]; none before the first sample
    std::string held;           ///< empty: nothing
  };
  /// State of an object that one or more hands hold.
  struct Carried {
    Vector3d p = Vector3d::Zero();             ///< position at the last call [m]
    double since = 0.0;                        ///< [s]
    std::map<std::string, double> last_touch;  ///< time of the last contact, by the other body's name [s]
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
  std::map<std::string, double> released_height_;  ///< height at release, of objects that may be falling [m]
};

}  // namespace spring_workbench::assembly
