#pragma once

#include <map>
#include <vector>

#include "spring_workbench/bodies/stepped_body.h"
#include "spring_workbench/rigid_bodies/rigid_world.h"

namespace spring_workbench::contact {

/// Contact mode `dynamic` (doc/model.md) where movable bodies are near: held bodies and all movable ones in one
/// rigid-body world. A held body that nothing can touch is carried by its own integrator alone; near others, all bodies
/// advance together in short substeps, in which the held body responds to contact with the compliance of its fork.
class DynamicStepper {
 public:
  explicit DynamicStepper(const scene::Scene& scene);

  rigid_bodies::RigidWorld& world() { return *world_; }
  const rigid_bodies::RigidWorld& world() const { return *world_; }

  struct Outcome {
    int substeps = 0;
    int unsolved = 0;        ///< substeps taken although a contact violated its law or a free body's path was not clear
    double time_lost = 0.0;  ///< time for which a held body was blocked: no motion was admissible or finite [s]
    double path_error = 0.0;  ///< largest estimated error of a free body's path over a substep [m]
    bool refused = false;     ///< the result of a substep without contact was non-finite or out of range
  };
  /// Carries the held bodies and the world over `h` [s].
  Outcome step(const std::vector<bodies::SteppedBody*>& held, double h);
  /// Starts the motion of a released body.
  void set_free(std::size_t body, const RigidTransform& X_WO, const Twist& V_WO_W);
  /// Returns the free bodies of the world that nothing movable will approach in the next `h` [s]. `moving`: indices in
  /// the scene of the bodies that move.
  std::vector<std::size_t> alone(const std::vector<std::size_t>& moving, double h) const;
  /// Returns whether any body that is not held moves.
  bool others_awake() const;
  /// Returns the contacts in the last call of step(). Their impulses are sums over its substeps, their positions are
  /// those of the last. The first body of a contact is movable; if one of the two is held, it comes first.
  const std::vector<rigid_bodies::WorldContact>& contacts() const { return contacts_; }

  /// Saves or restores the state between two steps, including that of the world.
  void archive(math::StateArchive& state);

 private:
  /// Motion of a held body over a substep under the contact load of the last one; the body is then at its end.
  struct Candidate {
    bodies::SteppedBody* body = nullptr;
    bodies::TrialStart start;
    motion::MotionState begin, end;
    Wrench load_W;
    Wrench impact_W;  ///< the impulse at its begin
    bool possible = false;
  };
  Candidate try_substep(bodies::SteppedBody& body, double h) const;
  /// Returns whether the paths of all candidates are free and only held bodies move.
  bool all_free(const std::vector<Candidate>& candidates) const;
  /// Returns what the world needs of a candidate: its displacement without the load, and the compliance at its end. The
  /// body is at the beginning of the substep.
  static rigid_bodies::DrivenBody driven_body(const Candidate& candidate, double h);
  /// Moves the bodies to where the candidates end.
  void step_freely(const std::vector<Candidate>& candidates, double h, Outcome& outcome);
  enum class Result { done, done_unsolved, too_long, stuck };
  /// Carries all bodies over one substep with contact. If a body would then penetrate another too deeply or pass
  /// through it, all bodies are restored and `h` is set to a shorter substep to try, unless none is short enough.
  Result step_in_contact(std::vector<Candidate> candidates, double& h);
  /// Returns how much of a substep to take, after the world has been advanced over it: until bodies bounce, or as long
  /// as paths are exact enough.
  double admissible_substep(double h);
  /// Advances the world over a substep, and returns the wrenches on the held bodies, which are still at its start.
  std::vector<rigid_bodies::DrivenBody> solve(const std::vector<Candidate>& candidates, double h);
  /// Carries the held bodies over a substep under these loads; returns the admissible fraction of their motions.
  double admissible_fraction(const std::vector<Candidate>& candidates,
                             const std::vector<rigid_bodies::DrivenBody>& driven, double h) const;
  /// Returns the same fraction of the motions that the solver predicted.
  double predicted_admissible_fraction(const std::vector<rigid_bodies::DrivenBody>& driven) const;
  /// Blocks the held bodies for one substep, while the others move on; shortens it to where these bounce.
  void block(const std::vector<bodies::SteppedBody*>& held, double& h, Outcome& outcome);
  void take(bodies::SteppedBody& body, const Wrench& contact_W);
  void add_contacts();
  bool has_priority(std::size_t body, std::size_t other) const;

  const scene::Scene& scene_;
  std::unique_ptr<rigid_bodies::RigidWorld> world_;
  std::vector<rigid_bodies::WorldContact> contacts_;
  std::vector<std::size_t> held_;         ///< indices in the scene of the bodies held in the last step
  std::map<std::size_t, Wrench> load_W_;  ///< contact loads on held bodies in the last substep
  double substep_;                        ///< longest substep in contact that should keep `max_path_error` [s]
  double min_substep_ = 0.0;              ///< [s] of the present step
};

}  // namespace spring_workbench::contact
