#pragma once

#include <map>
#include <string>
#include <vector>

#include "spring_workbench/assembly/placement.h"
#include "spring_workbench/assembly/task_score.h"
#include "spring_workbench/simulation/simulation.h"

namespace spring_workbench::assembly {

/// Watches an assembly: which object is in place, and the score. It only looks, and changes nothing.
class TaskMonitor {
 public:
  /// Judges by the targets of `scene`; one without targets has no task, and `observe` does nothing.
  explicit TaskMonitor(const scene::Scene& scene);

  /// Call after each `advance`: what happens between two calls is not seen.
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
  /// What was seen at the last call.
  struct Last {
    double t = 0.0;
    Vector3d hand = Vector3d::Zero();
    std::string held;  ///< empty: nothing
    Vector3d p_held = Vector3d::Zero();
  };

  void judge(const std::vector<bodies::BodyState>& objects);
  void add_ways(const tools::ToolState& tool, const bodies::BodyState* held);
  void note_hold(double t, const bodies::BodyState* held);
  void note_contacts(double t, const std::vector<contact::ContactState>& contacts, const std::string& held);
  void note_drops(const std::vector<bodies::BodyState>& objects);
  bool is_fixed(const std::string& name) const;

  std::vector<std::string> movable_;
  std::vector<Watched> watched_;
  std::vector<Placement> placements_;
  TaskScore score_;
  bool started_ = false;
  double begin_ = 0.0;
  Last last_;
  double held_since_ = 0.0;
  std::map<std::string, double> last_touch_;       ///< of the held object: by the other's name [s]
  std::map<std::string, double> released_height_;  ///< of objects that may be falling [m]
};

}  // namespace spring_workbench::assembly
