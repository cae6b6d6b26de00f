#pragma once

#include <functional>
#include <vector>

#include "spring_workbench/bodies/stepped_body.h"
#include "spring_workbench/collision/collision_world.h"
#include "spring_workbench/contact/contact_solver.h"

namespace spring_workbench::contact {

/// What contact did in a step.
struct ContactOutcome {
  std::vector<ContactRow> rows;  ///< the contacts at the end of the step; `load_W` [N]
  int queries = 0;
  double time_lost = 0.0;  ///< [s] for which nothing fitted and the body was stopped
  bool refused = false;    ///< a step without contact would not have been finite or bounded
};

/// Contact mode `stop` (doc/model.md; the paper's section 5): the candidate step is swept, cut at the first contact by
/// bisection, and goes on from there under contact loads that keep the body out of the others, which do not move.
class ContactStepper {
 public:
  ContactStepper(const scene::Scene& scene, collision::CollisionWorld& collision, int bisection_levels);

  /// Whether the way between two poses is one that the body goes with nothing movable about.
  using MayGo = std::function<bool(const RigidTransform& X0_WO, const RigidTransform& X1_WO)>;
  /// Carries the body over `h` [s]. `rows`: its contacts at the end of the last step; replaced by those at the end of
  /// this. False, and the body is restored, if it may not move (or not over the first substep).
  bool step(bodies::SteppedBody& body, double h, const MayGo& may_go, std::vector<ContactRow>& rows,
            ContactOutcome& outcome);

 private:
  const scene::Material& material(std::size_t body) const;  ///< also of the bench
  /// Contacts that are still there, or within `depth` [m] along their normals, with their gaps at the present pose.
  void refresh(const bodies::SteppedBody& body, std::vector<ContactRow>& rows, double depth,
               ContactOutcome& outcome) const;
  /// Adds contacts found with the body at `X_WO`; gaps as they are there.
  void add_contacts(std::size_t body, const RigidTransform& X_WO, double tolerance, std::vector<ContactRow>& rows,
                    ContactOutcome& outcome) const;
  /// Takes away the speed with which the contacts approach, perfectly inelastic or with the materials' restitution.
  /// What is open may approach so fast that it closes in `h` [s]: so what lands with several points lands at once.
  enum class Bounce { none, of_materials };
  void collide(bodies::SteppedBody& body, const std::vector<ContactRow>& rows, Bounce bounce, double h) const;
  /// Goes `h` on, from the start of the present trial, under loads that leave the rows' gaps closed or open. False when
  /// it did not come out free.
  bool advance_in_contact(bodies::SteppedBody& body, double h, std::vector<ContactRow>& rows,
                          ContactOutcome& outcome) const;
  /// Position of a contact's point of the body at the start of a substep.
  struct Start {
    double gap = 0.0;                     ///< [m]
    Vector3d lever_W = Vector3d::Zero();  ///< from the object's centre [m]
  };
  /// Gaps and slips of the contacts `work` with the body at the end of a substep from `X0` on; contacts that have come
  /// into being on the way join, and those that lie deeper than their points' motion says are taken as they are found.
  void look_at_end(const bodies::SteppedBody& body, const RigidTransform& X0, std::vector<ContactRow>& work,
                   std::vector<Start>& starts, ContactOutcome& outcome) const;
  /// Result of a substep.
  struct Piece {
    bool done = false;                ///< the body has gone it
    double next = 0.0;                ///< length of the next substep to try, relative to this one
    std::vector<ContactRow> touched;  ///< not done: what was in the way
    bool solved = true;               ///< loads were found, with which the body can be carried
    bool allowed = true;              ///< it may go there
  };
  /// Tries to go `h` on, under the rows' loads where there are rows. Not done, the body is where it was.
  Piece try_substep(bodies::SteppedBody& body, double h, const MayGo& may_go, std::vector<ContactRow>& rows,
                    ContactOutcome& outcome) const;
  /// Corrects the impulses that the rows' loads have given over a substep of `h` [s] so that no contact approaches at
  /// its end, and none slips where friction, which is constant over the substep, has reversed its slip or could have
  /// held it.
  void settle(bodies::SteppedBody& body, const std::vector<ContactRow>& rows, double h) const;
  /// Adds those contacts that are new and takes away the speed with which they approach. False when none was.
  bool meet(bodies::SteppedBody& body, const std::vector<ContactRow>& touched, double h, std::vector<ContactRow>& rows,
            ContactOutcome& outcome) const;
  /// How far the way between two states, `h` apart, is from the straight one [m].
  double chord_deviation(std::size_t body, const motion::MotionState& begin, const motion::MotionState& end,
                         double h) const;
  /// What is in the way between two states.
  struct Obstruction {
    bool hit = false;
    double free = 1.0;                                 ///< the free part of the way, 0 … 1
    RigidTransform X_WO = RigidTransform::Identity();  ///< where the body touches
  };
  /// Sweeps the Hermite interpolant between two states, as so many straight ones as its bow asks for.
  Obstruction sweep(std::size_t body, const motion::MotionState& begin, const motion::MotionState& end, double h,
                    double tolerance) const;

  const scene::Scene& scene_;
  collision::CollisionWorld& collision_;
  int levels_;
  std::vector<double> radius_;        ///< of every body of the scene [m]
  mutable bodies::TrialStart start_;  ///< of the present trial: no allocation in a step
};

}  // namespace spring_workbench::contact
