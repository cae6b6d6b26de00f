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
  /// Contacts since the last call of step began; impulses are sums over its pieces, places those of the last.
  const std::vector<WorldContact>& contacts() const { return contacts_; }

 private:
  struct Way {
    RigidTransform X0, X1;
    bool possible = false;
  };
  Way way(SteppedBody& body, double h) const;
  /// Carries all over one piece.
  void piece(const std::vector<SteppedBody*>& held, double h, Outcome& outcome);
  void add_contacts();

  const Scene& scene_;
  std::unique_ptr<RigidWorld> world_;
  std::vector<double> radius_;  ///< of every body of the scene [m]
  std::vector<WorldContact> contacts_;
};

}  // namespace spring_workbench
