#pragma once

#include <map>
#include <vector>

#include "spring_workbench/bodies/stepped_body.h"
#include "spring_workbench/rigid_bodies/rigid_world.h"

namespace spring_workbench::contact {

/// Contact mode `dynamic` (doc/model.md) where movable bodies are near: held bodies and all movable ones in one
/// rigid-body world. A held body that nothing can touch is carried by its own integrator alone; near others, all go on
/// together in short substeps, in which the held body responds to contact with the compliance of its fork.
class DynamicStepper {
 public:
  explicit DynamicStepper(const scene::Scene& scene);

  rigid_bodies::RigidWorld& world() { return *world_; }
  const rigid_bodies::RigidWorld& world() const { return *world_; }

  struct Outcome {
    int substeps = 0;
    double time_lost =
        0.0;               ///< [s] for which contact left a held body no way, and it was stopped; or it was refused one
    bool refused = false;  ///< the result of a substep without contact was not finite or bounded
  };
  /// Carries the held bodies and the world over `h` [s].
  Outcome step(const std::vector<bodies::SteppedBody*>& held, double h);
  /// Starts the motion of a released body.
  void set_free(std::size_t body, const RigidTransform& X_WO, const Twist& V_WO_W);
  /// The free bodies of the world that nothing movable, `moving` [in the scene] on its way, will come near in the next
  /// `h` [s].
  std::vector<std::size_t> alone(const std::vector<std::size_t>& moving, double h) const;
  /// Whether a body that is not held moves.
  bool others_awake() const;
  /// The bodies of a contact are a movable one and another; a held one comes first. Contacts since the last call of
  /// step began; impulses are sums over its substeps, positions those of the last.
  const std::vector<rigid_bodies::WorldContact>& contacts() const { return contacts_; }

  /// Between two steps, the world included.
  void exchange(math::StateArchive& state);

 private:
  /// Motion of a held body over a substep under the contact load of the last one; the body is then at its end.
  struct Candidate {
    bodies::SteppedBody* body;
    bodies::TrialStart start;
    motion::MotionState begin, end;
    Wrench load_W;
    Wrench impact_W;  ///< the impulse at its begin
    bool possible = false;
  };
  Candidate try_substep(bodies::SteppedBody& body, double h) const;
  /// Whether nothing is in the way of any of them, and nothing that is not held moves.
  bool all_free(const std::vector<Candidate>& candidates) const;
  /// What goes into the world of a candidate: its way without the load, and how its end answers to one. The body is at
  /// its begin.
  static rigid_bodies::DrivenBody driven_body(const Candidate& candidate, double h);
  /// The candidates are where the bodies go.
  void go_freely(const std::vector<Candidate>& candidates, double h, Outcome& outcome);
  enum class Piece { gone, too_long, stuck };
  /// Carries all bodies over one substep with contact, unless that would bring a body too deep into another or through
  /// it; then all are restored, and `h` is a substep to try instead, or none is short enough.
  Piece go_in_contact(std::vector<Candidate> candidates, double& h);
  /// Advances the world over a substep, and returns the contact wrenches on the held bodies, which are still at its
  /// start.
  std::vector<rigid_bodies::DrivenBody> solve(const std::vector<Candidate>& candidates, double h);
  /// Carries the held bodies over a substep under these loads; returns the admissible fraction of their motions.
  double admissible_fraction(const std::vector<Candidate>& candidates,
                             const std::vector<rigid_bodies::DrivenBody>& driven, double h) const;
  /// The same of the ways that the solver foresaw for them.
  double foreseen_admissible_fraction(const std::vector<rigid_bodies::DrivenBody>& driven) const;
  /// Blocks the held bodies for one substep, while the others move on.
  void hold_back(const std::vector<bodies::SteppedBody*>& held, double h, Outcome& outcome);
  void take(bodies::SteppedBody& body, const Wrench& contact_W);
  void add_contacts();
  bool comes_first(std::size_t body, std::size_t other) const;

  const scene::Scene& scene_;
  std::unique_ptr<rigid_bodies::RigidWorld> world_;
  std::vector<rigid_bodies::WorldContact> contacts_;
  std::vector<std::size_t> held_;         ///< in the last step
  std::map<std::size_t, Wrench> load_W_;  ///< of contact on held bodies in the last substep
  double shortest_piece_ = 0.0;           ///< [s] of the present step
};

}  // namespace spring_workbench::contact
