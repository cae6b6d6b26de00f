#pragma once

#include <vector>

#include "spring_workbench/world/rigid_world.h"
#include "stepped_body.h"

namespace spring_workbench {

/// Contact mode `dynamic` (doc/model.md): held bodies and all movable ones in one rigid-body world. A held body that
/// nothing can touch is carried by its own integrator alone; near others, all go on together in short pieces, in which the
/// held body answers to contact with the compliance of its fork.
class DynamicStepper {
 public:
  explicit DynamicStepper(const Scene& scene);

  RigidWorld& world() { return *world_; }
  const RigidWorld& world() const { return *world_; }

  struct Outcome {
    int pieces = 0;
    bool held_back = false;  ///< a held body could not be carried on and was stopped
  };
  /// Carries the held bodies and the world over `h` [s].
  Outcome step(const std::vector<SteppedBody*>& held, double h);
  /// Puts a body that nobody holds any more on its way.
  void set_free(std::size_t body, const RigidTransform& X_WO, const Twist& V_WO_W);
  /// Whether a body that is not held moves.
  bool others_awake() const;
  /// The bodies of a contact are a movable one and another; a held one comes first. Contacts since the last call of step began; impulses are sums over its pieces, places those of the last.
  const std::vector<WorldContact>& contacts() const { return contacts_; }

 private:
  struct Way {
    RigidTransform X0, X1;
    Twist V1;  ///< at the end, world axes
    bool possible = false;
  };
  Way way(SteppedBody& body, double h) const;
  /// Carries all over one piece.
  void piece(const std::vector<SteppedBody*>& held, double h, Outcome& outcome);
  void add_contacts();
  bool comes_first(std::size_t body, std::size_t other) const;

  const Scene& scene_;
  std::unique_ptr<RigidWorld> world_;
  std::vector<double> radius_;  ///< of every body of the scene [m]
  std::vector<WorldContact> contacts_;
  std::vector<std::size_t> held_;  ///< in the last step
};

}  // namespace spring_workbench
