#pragma once

#include <memory>
#include <set>
#include <string>
#include <vector>

#include "spring_workbench/bodies/free_body.h"
#include "spring_workbench/contact/contact_log.h"
#include "spring_workbench/contact/dynamic_stepper.h"
#include "spring_workbench/objects/object_list.h"

namespace spring_workbench::objects {

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

/// The movable objects of a scene in free flight and asleep: what lets them fly, wakes them and puts them to sleep, and
/// carries one on which only fixed bodies act.
class FreeObjects : public ObjectList {
 public:
  /// Time begins at `now` [s].
  void begin(double now);
  /// Whether an object is in free flight: not held and not asleep.
  bool any_free() const;
  contact::ContactLog& contacts() { return contacts_; }
  const contact::ContactLog& contacts() const { return contacts_; }
  void take_state(std::size_t object, const motion::MotionState& s);
  /// Returns the name of a body that the object, at `X_WO`, would overlap by more than `support_gap`; empty if none.
  std::string inside_of(std::size_t object, const RigidTransform& X_WO) const;
  /// Wakes the sleeping objects that rest on `object`, directly or through other objects.
  void wake_what_lies_on(std::size_t object, double now);

 protected:
  /// Keeps a reference to `scene`. `bisection_levels`: of the search for contact.
  FreeObjects(const scene::Scene& scene, int bisection_levels);

  /// Puts all objects back to their initial poses, asleep except for those that fall from there.
  void put_back();
  /// Returns false, and does nothing, if `may_go` forbids the motion.
  bool carry(bodies::SteppedBody& stepped, std::size_t object, double h, const contact::ContactStepper::MayGo& may_go,
             StepCounts& counts);
  static void note(const contact::ContactOutcome& outcome, StepCounts& counts);
  /// Continues an object without a tool from its present state; a massless one stays where it is.
  void let_fly(std::size_t object, double now);
  void set_free(std::size_t object, const Twist& V_WO_W, double now);
  void put_to_sleep_if_slow(std::size_t object, double now);
  bool touches_what_moves(std::size_t object) const;

  std::unique_ptr<collision::CollisionWorld> collision_;      ///< null without contact
  std::unique_ptr<contact::ContactStepper> contact_stepper_;  ///< likewise
  std::unique_ptr<contact::DynamicStepper> dynamic_stepper_;  ///< of contact mode `dynamic` alone
  contact::ContactLog contacts_;
  /// What is kept of a movable object in addition to its state.
  struct Object {
    int grasping = 0, pushing = 0;                ///< tools that carry it
    std::unique_ptr<bodies::FreeBody> free_body;  ///< null while held, asleep or among movable bodies
    std::vector<contact::ContactRow> rows;        ///< of its last step
    double slow_since = 0.0;                      ///< [s]

    bool carried() const { return grasping + pushing > 0; }
  };
  std::vector<Object> objects_;
  std::set<std::size_t> free_;  ///< those with a free body; a few of many objects: a step visits only these

 private:
  /// Wakes the objects that nothing supports, and all that lie on them.
  void let_fall();

  bodies::TrialStart start_;  ///< of a step without contact; no allocation there
};

}  // namespace spring_workbench::objects
