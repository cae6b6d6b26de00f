#pragma once

#include <functional>
#include <vector>

#include "spring_workbench/bodies/stepped_body.h"
#include "spring_workbench/collision/collision_world.h"
#include "spring_workbench/contact/contact_solver.h"

namespace spring_workbench::contact {

/// Result of contact in one step.
struct ContactOutcome {
  std::vector<ContactRow> rows;  ///< the contacts of the step, also those that are over at its end
  int queries = 0;
  double time_lost = 0.0;  ///< time for which no motion was possible and the body was stopped [s]
  bool refused = false;    ///< a step without contact would not have been finite or bounded
};

/// Contact mode `stop` (doc/model.md; the paper's section 5): the candidate step is swept and cut at the first contact
/// by bisection; the body then continues under contact loads that keep it out of the others, which do not move.
class ContactStepper {
 public:
  ContactStepper(const scene::Scene& scene, collision::CollisionWorld& collision, int impact_bisections);

  /// Returns whether nothing movable is near the path of the body between two poses.
  using MotionCheck = std::function<bool(const RigidTransform& X0_WO, const RigidTransform& X1_WO)>;
  /// Carries the body over `h` [s]. `rows`: its contacts at the end of the last step, replaced by those at the end of
  /// this one. Returns false, and restores the body, if `is_allowed` forbids the motion or the first substep of it.
  bool step(bodies::SteppedBody& body, double h, const MotionCheck& is_allowed, std::vector<ContactRow>& rows,
            ContactOutcome& outcome);

 private:
  const scene::Material& material(std::size_t body) const;  ///< also of the bench
  /// Keeps the contacts that exist or are within `depth` [m] along their normals, with their gaps at the present pose.
  void refresh(const bodies::SteppedBody& body, std::vector<ContactRow>& rows, double depth,
               ContactOutcome& outcome) const;
  /// Adds the contacts found with the body at `X_WO`, with the gaps at that pose.
  void add_contacts(std::size_t body, const RigidTransform& X_WO, double tolerance, std::vector<ContactRow>& rows,
                    ContactOutcome& outcome) const;
  /// Removes the approach speed of the contacts, with the restitution of the materials or none. An open contact keeps
  /// at most the speed at which it closes in `h` [s], so a body lands on several points at once. Compliant materials
  /// that are loaded or approach slowly yield as over the next substep, of `substep` [s].
  enum class Bounce { none, of_materials };
  void collide(bodies::SteppedBody& body, std::vector<ContactRow>& rows, Bounce bounce, double h, double substep) const;
  /// Advances the body by `h` from the start of the present trial, under loads that leave the gaps of the rows closed
  /// or open. Returns false if the body then penetrates.
  bool advance_in_contact(bodies::SteppedBody& body, double h, std::vector<ContactRow>& rows,
                          ContactOutcome& outcome) const;
  /// Position of a contact's point of the body at the start of a substep.
  struct Start {
    double gap = 0.0;                     ///< [m]
    Vector3d lever_W = Vector3d::Zero();  ///< from the object's centre [m]
    bool rolls = false;                   ///< another point of a round body touches at the end
  };
  /// Computes gaps and slips of the contacts `work` at the end of a substep that began at `X0`. Contacts that have
  /// begun on the path are added; one that is deeper than the motion of its points predicts, or rolled, is replaced:
  /// one of a round body if its point is lifted by more than `fine` [m].
  void look_at_end(const bodies::SteppedBody& body, const RigidTransform& X0, double fine,
                   std::vector<ContactRow>& work, std::vector<Start>& starts, ContactOutcome& outcome) const;
  /// Result of a substep.
  struct Substep {
    bool done = false;                ///< the body has made this substep
    double next = 0.0;                ///< length of the next substep to try, relative to this one
    std::vector<ContactRow> touched;  ///< if not done: the obstacles
    bool allowed = true;              ///< `is_allowed` allows the motion
  };
  /// Tries to advance by `h`, under the loads of the rows if there are any. If it fails, the body is where it was.
  Substep try_substep(bodies::SteppedBody& body, double h, const MotionCheck& is_allowed, std::vector<ContactRow>& rows,
                      ContactOutcome& outcome) const;
  /// Corrects the impulses of the rows' loads over a substep of `h` [s] so that no contact approaches at its end, and
  /// none slips where friction, which is constant over it, has reversed its slip or could have held it.
  void correct_impulses(bodies::SteppedBody& body, std::vector<ContactRow>& rows, double h) const;
  /// Adds the contacts that are new and removes their approach speed. Returns false if none is new.
  bool meet(bodies::SteppedBody& body, const std::vector<ContactRow>& touched, double h, double substep,
            std::vector<ContactRow>& rows, ContactOutcome& outcome) const;
  /// Returns the chord deviation [m] of the path between two states that are `h` [s] apart.
  double chord_deviation(std::size_t body, const motion::MotionState& begin, const motion::MotionState& end,
                         double h) const;
  /// Obstacle on the path between two states.
  struct Obstruction {
    bool hit = false;
    double free = 1.0;                                 ///< collision-free fraction of the path, 0 … 1
    RigidTransform X_WO = RigidTransform::Identity();  ///< pose in which the body touches
  };
  /// Sweeps the Hermite interpolant between two states as straight segments, as many as its chord deviation requires.
  Obstruction sweep(std::size_t body, const motion::MotionState& begin, const motion::MotionState& end, double h,
                    const collision::Tolerance& tolerance) const;

  const scene::Scene& scene_;
  collision::CollisionWorld& collision_;
  int levels_;
  std::vector<double> radius_;  ///< radius of every body of the scene [m]
  // Members so that a step allocates little.
  mutable bodies::TrialStart start_;  ///< start of the present trial
  mutable friction::ContactProblem problem_;
};

}  // namespace spring_workbench::contact
