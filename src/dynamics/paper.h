#pragma once

#include "exponential.h"
#include "spring_workbench/dynamics/integrator.h"
#include "spring_workbench/math/damped_oscillator.h"

namespace spring_workbench::dynamics {

/// The paper's own scheme (sections 3.3 and 5), extended to every damping ratio. In each step the fork gets a target:
/// the strain at which it would rest under the weight and the force and moment that change the object's velocity over
/// the step if the fork is rigid, first bend and stretch, then torsion. If the object would collide on its path to the
/// target, the target is cut back (HeldBody::path_check); the result is the candidate. The spring-damper of each DOF,
/// with the object's mass (torsion: its moment of inertia about the fork's axis), starts at the present distance from
/// the candidate with the present speed, and its closed form carries it over the step, including a contact load.
///
/// The target does not depend on the state: no stiffness, mass or step makes this relaxation unstable. Its limit for
/// short steps, which it approaches with order one, is not the equation of motion: the DOFs do not affect each other,
/// nor does the strain affect the load. The error estimates are of the distance from its own limit.
class Paper final : public Integrator {
 public:
  int order() const override { return 1; }
  bool stiffly_stable() const override { return true; }
  Energy energy() const override { return Energy::not_applicable; }
  StepEstimate step(const HeldBody& body, const motion::Trajectory& handle, double t, double h,
                    StrainState& state) override;
  void propagate_deviation(const HeldBody& body, const motion::Trajectory& handle, double t, double h,
                           const StrainState& begin, const StrainState& end, StrainState& deviation) override;
  Response response(const HeldBody& body, const HandleState& handle, double h, const StrainState& state) override;
  void archive(math::StateArchive& state) override { state(version_, t_, from_, target_, shared_); }

 private:
  long version_ = -1;                ///< of the equations to which the other members belong
  double t_ = 0.0;                   ///< start of the last step [s]
  rod::StrainVector from_, target_;  ///< start of the search for its target; the target, from which the next one starts
  Exponential shared_;               ///< for an object that other tools pull at, too: the paper has only one fork
};

}  // namespace spring_workbench::dynamics
