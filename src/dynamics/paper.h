#pragma once

#include "exponential.h"
#include "spring_workbench/dynamics/integrator.h"
#include "spring_workbench/math/damped_oscillator.h"

namespace spring_workbench::dynamics {

/// The paper's own scheme (sections 3.3 and 5), here for every damping ratio. In each step the fork gets a target: the
/// strain at which it would rest under the load of the new hand, which is the weight, the force and the moment that
/// the object's change of velocity takes where the fork is rigid; bend and stretch first, then torsion.
/// Cut back where the object would collide on its way there, it is the candidate (HeldBody::path_check). The
/// spring-damper of each DOF, with the object's mass (torsion: its moment of inertia about the fork's axis), starts at
/// the present distance from the candidate, with the present speed, and its closed form carries it over the step,
/// a load of contact included.
///
/// The target does not depend on the state: a relaxation that no stiffness, mass or step makes unstable. Its limit for
/// short steps, which it comes to with order one, is not the equation of motion: the DOFs do not act on each other nor
/// does the strain act on the load. Estimates are of the distance from its own limit.
class Paper final : public Integrator {
 public:
  int order() const override { return 1; }
  bool stiffly_stable() const override { return true; }
  Energy energy() const override { return Energy::of_its_own; }
  StepEstimate step(const HeldBody& body, const motion::FrameMotion& handle, double t, double h,
                    StrainState& state) override;
  Response response(const HeldBody& body, const HandleForcing& handle, double h, const StrainState& state) override;
  void exchange(math::StateArchive& state) override { state(version_, t_, from_, target_, shared_); }

 private:
  long version_ = -1;                ///< of the equations that the rest is of
  double t_ = 0.0;                   ///< begin of the last step [s]
  rod::StrainVector from_, target_;  ///< where its target was looked for, and is: the next one's from there
  Exponential shared_;               ///< the paper has one fork: what other tools pull at, too, this one carries
};

}  // namespace spring_workbench::dynamics
