#pragma once

#include <vector>

#include "spring_workbench/bodies/body_pair.h"
#include "spring_workbench/collision/neighbourhood.h"
#include "spring_workbench/contact/contact_stepper.h"

namespace spring_workbench::objects {

/// Steps two free bodies that come near each other and nothing else, as one body (bodies::BodyPair), by the step of
/// contact mode `stop`.
class FreePairs {
 public:
  /// Keeps references to the arguments.
  FreePairs(const scene::Scene& scene, const collision::CollisionWorld& collision, contact::ContactStepper& stepper);

  /// Starts a step of `h` [s]. Bodies that are not added are at rest.
  void begin(double h);
  void add_moving(std::size_t body, const RigidTransform& X_WO, const Twist& V_WO_W);
  /// Advances both by the step. `rows`: the contacts of the first with the second, as in contact::ContactStepper::step,
  /// in world. Returns false if one of them comes near anything else; the arguments are then left in an undefined
  /// state.
  bool step(bodies::BodyPair& pair, std::vector<contact::ContactRow>& rows, contact::ContactOutcome& outcome) const;

 private:
  bool alone(const bodies::BodyPair& pair) const;

  contact::ContactStepper& stepper_;
  collision::Neighbourhood around_;
  double h_ = 0.0;
};

}  // namespace spring_workbench::objects
