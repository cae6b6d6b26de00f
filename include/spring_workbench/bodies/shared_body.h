#pragma once

#include <vector>

#include "spring_workbench/bodies/coupled_tool.h"
#include "spring_workbench/bodies/free_body.h"

namespace spring_workbench::bodies {

/// An object on several tools, or pushed by the probe: a free rigid body, and the tools' springs and dampers on it. All
/// of them enter implicitly (backward Euler, of order one): no stiffness, however large, makes a step unstable, and
/// statics are exact. Tools without any give (rigid ones, families off) give way by a share of what a free body would,
/// so that two of them that ask for different poses meet half way.
class SharedBody final : public SteppedBody {
 public:
  /// Keeps references to `body` and the tools, which must be there as long as this.
  SharedBody(std::size_t index, const scene::Body& body, double gravity, const RigidTransform& X_WO,
             const Twist& V_WO_W, std::vector<CoupledTool*> tools);

  std::size_t index() const override { return free_.index(); }
  motion::MotionState object() const override { return free_.object(); }
  bool advance(double h, const Wrench& contact_W) override;
  void save(TrialStart& start) const override;
  void restore(const TrialStart& start) override;
  Response response(double h) const override;
  Matrix6d mobility() const override { return free_.mobility(); }
  void add_impulse(const Wrench& impulse_W) override { free_.add_impulse(impulse_W); }
  void block(double h) override;

 private:
  struct Pulls;  ///< the tools' couplings as one system of equations
  Pulls pulls(double h) const;
  struct State {
    TrialStart free;
    std::vector<TrialStart> tools;
  };

  FreeBody free_;
  std::vector<CoupledTool*> tools_;
};

}  // namespace spring_workbench::bodies
