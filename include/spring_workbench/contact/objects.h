#pragma once

#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "spring_workbench/bodies/free_body.h"
#include "spring_workbench/contact/contact_log.h"
#include "spring_workbench/contact/dynamic_stepper.h"
#include "spring_workbench/contact/object_list.h"

namespace spring_workbench::contact {

/// Body that a tool carries over a step.
struct Carried {
  std::size_t object;  ///< in the workbench
  bodies::SteppedBody* body;
};

/// What steps did.
struct StepCounts {
  int steps = 0;
  int steps_among_movable = 0;  ///< those of `steps` with other movable objects (contact mode `dynamic`)
  int collision_queries = 0;
  int steps_blocked = 0;   ///< no admissible motion of a body was found, so that it stayed
  int steps_unsolved = 0;  ///< of `steps_among_movable`: taken although a contact of theirs missed its law
  int steps_rejected = 0;  ///< the result was not finite or bounded
  double time_lost = 0.0;  ///< time during which a body did not follow its equation [s]

  void note(double lost, bool refused) {
    steps_blocked += lost > 0.0 ? 1 : 0;
    steps_rejected += refused ? 1 : 0;
    time_lost += lost;
  }
};

/// The movable objects of a scene, held, in free flight or asleep, and their contacts. A tool takes an object with
/// `hold`, carries it in `step`, and gives it back with `let_go`.
class Objects : public ObjectList {
 public:
  /// Keeps a reference to `scene`. `bisection_levels`: of the search for contact.
  Objects(const scene::Scene& scene, int bisection_levels);

  /// Puts all objects back to their initial poses, asleep except for those that fall from there.
  void reset();
  /// Time begins at `now` [s].
  void begin(double now);
  /// Takes over the state of the objects of the same names in `before`, which are those of another scene; other objects
  /// begin at their start poses.
  void continue_from(const Objects& before, double now);

  /// Whether an object is in free flight: not held and not asleep.
  bool any_free() const;
  ContactLog& contacts() { return contacts_; }
  const ContactLog& contacts() const { return contacts_; }

  enum class Grip { grasp, push };
  /// A tool takes the object, or begins to push it, at time `now` [s]; what lies on it wakes.
  void hold(std::size_t object, Grip grip, double now);
  /// A tool that took the object leaves it. After the last one it flies on with its twist (`thrown`) or from rest; a
  /// massless one stays where it is.
  void let_go(std::size_t object, Grip grip, bool thrown, double now);
  void take_state(std::size_t object, const motion::MotionState& s);
  /// Returns the name of a body that the object, at `X_WO`, would overlap by more than `support_gap`; empty if none.
  std::string inside_of(std::size_t object, const RigidTransform& X_WO) const;
  /// Places an object that no tool holds or pushes at `X_WO`, at rest; it falls from there.
  void place(std::size_t object, const RigidTransform& X_WO, double now);

  /// Wakes the sleeping objects that rest on `object`, directly or through other objects.
  void wake_what_lies_on(std::size_t object, double now);
  /// Returns whether everything that a held object could touch is at rest.
  bool rests(std::size_t object) const;

  /// Carries held and free objects over `h` [s] from `now` on, with the contact mode of the scene. An object that has
  /// been slow for long enough falls asleep.
  void step(const std::vector<Carried>& held, double now, double h, StepCounts& counts);

  /// Between two calls of `advance`.
  void exchange(math::StateArchive& state);

 private:
  /// Contact mode `dynamic`: objects that have only fixed bodies near them are carried as in mode `stop`, all others
  /// together in one rigid-body world.
  void step_among_movable(const std::vector<Carried>& held, double now, double h, StepCounts& counts);
  void step_together(const std::vector<Carried>& held, const std::vector<std::size_t>& moving, double now, double h,
                     StepCounts& counts);
  void note_world_contacts(double h);
  /// Returns false, and does nothing, if `may_go` forbids the motion.
  bool carry(bodies::SteppedBody& stepped, std::size_t object, double h, const ContactStepper::MayGo& may_go,
             StepCounts& counts);
  /// Continues an object without a tool from its present state; a massless one stays where it is.
  void let_fly(std::size_t object, double now);
  void set_free(std::size_t object, const Twist& V_WO_W, double now);
  /// Wakes the objects that nothing supports, and all that lie on them.
  void let_fall();
  void put_to_sleep_if_slow(std::size_t object, double now);
  bool touches_what_moves(std::size_t object) const;

  std::unique_ptr<collision::CollisionWorld> collision_;  ///< null without contact
  std::unique_ptr<ContactStepper> contact_stepper_;       ///< likewise
  std::unique_ptr<DynamicStepper> dynamic_stepper_;       ///< of contact mode `dynamic` alone
  ContactLog contacts_;
  /// What is kept of a movable object in addition to its state.
  struct Object {
    int grasping = 0, pushing = 0;                ///< tools that carry it
    std::unique_ptr<bodies::FreeBody> free_body;  ///< null while held, asleep or among movable bodies
    std::vector<ContactRow> rows;                 ///< of its last step
    double slow_since = 0.0;                      ///< [s]
  };
  std::vector<Object> objects_;
  bodies::TrialStart start_;  ///< of a step without contact; no allocation there
  // A few of many objects: a step visits only these.
  std::set<std::size_t> free_;        ///< those with a free body
  std::set<std::size_t> in_contact_;  ///< with contact mode `dynamic`
};

}  // namespace spring_workbench::contact
