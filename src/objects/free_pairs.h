#pragma once

#include <vector>

#include "spring_workbench/bodies/body_pair.h"
#include "spring_workbench/collision/neighbourhood.h"
#include "spring_workbench/contact/contact_stepper.h"

namespace spring_workbench::objects {

/// Carries two free bodies that come near each other and nothing else: as one body (bodies::BodyPair), by the step of
/// contact mode `stop`.
class FreePairs {
 public:
  /// Keeps references.
  FreePairs(const scene::Scene& scene, const collision::CollisionWorld& collision, contact::ContactStepper& stepper);

  /// A step begins, of `h` [s]; nothing moves but what is added.
  void begin(double h);
  void add_moving(std::size_t body, const RigidTransform& X_WO, const Twist& V_WO_W);
  /// Carries both over the step. `rows`: the contacts of the first with the second, as in
  /// contact::ContactStepper::step, in world. Returns false if one of them comes near anything else; then none of the
  /// arguments means anything.
  bool step(bodies::BodyPair& pair, std::vector<contact::ContactRow>& rows, contact::ContactOutcome& outcome) const;

 private:
  bool alone(const bodies::BodyPair& pair) const;

  contact::ContactStepper& stepper_;
  collision::Neighbourhood around_;
  double h_ = 0.0;
};

}  // namespace spring_workbench::objects
