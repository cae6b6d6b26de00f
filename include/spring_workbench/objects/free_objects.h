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

/// Counts of what the steps did.
struct StepCounts {
  int steps = 0;
  int steps_among_movable = 0;  ///< steps that involved other movable objects (contact mode `dynamic`)
  int collision_queries = 0;
  int steps_blocked = 0;    ///< steps in which no admissible motion of a body was found, so it did not move
  int steps_unsolved = 0;   ///< substeps among movable objects that were accepted although a contact violated its law
  int steps_rejected = 0;   ///< steps whose result was not finite or not bounded
  double path_error = 0.0;  ///< largest estimated error of a free object's path over a substep among movable ones [m]
  double time_lost = 0.0;   ///< time during which a body did not follow its equation [s]

  void note(double lost, bool refused) {
    steps_blocked += lost > 0.0 ? 1 : 0;
    steps_rejected += refused ? 1 : 0;
    time_lost += lost;
  }
};

/// The movable objects of a scene in free flight or asleep: releases them, wakes them and puts them to sleep, and steps
/// an object on which only fixed bodies act.
class FreeObjects : public ObjectList {
 public:
  /// Sets the start time `now` [s].
  void begin(double now);
  /// Whether any object is in free flight: neither held nor asleep.
  bool any_free() const;
  contact::ContactLog& contacts() { return contacts_; }
  const contact::ContactLog& contacts() const { return contacts_; }
  void take_state(std::size_t object, const motion::MotionState& s);
  /// Returns the name of a body that the object would overlap at `X_WO` by more than `support_gap`; empty if there is
  /// none.
  std::string overlapped_body(std::size_t object, const RigidTransform& X_WO) const;
  /// Lets the objects that rest on `object`, directly or through other objects, move freely.
  void wake_supported_by(std::size_t object, double now);

 protected:
  /// Keeps a reference to `scene`. `impact_bisections`: of the search for the first contact.
  FreeObjects(const scene::Scene& scene, int impact_bisections);

  /// Returns all objects to their initial poses, asleep unless they would fall from there.
  void return_to_start();
  /// Returns false, and does nothing, if `is_allowed` forbids the motion.
  bool carry(bodies::SteppedBody& stepped, std::size_t object, double h,
             const contact::ContactStepper::MotionCheck& is_allowed, StepCounts& counts);
  static void note(const contact::ContactOutcome& outcome, StepCounts& counts);
  /// Releases an object into free flight from its current state; a massless one stays in place.
  void start_free_flight(std::size_t object, double now);
  void set_free(std::size_t object, const Twist& V_WO_W, double now);
  void put_to_sleep_if_slow(std::size_t object, double now);
  bool touches_moving_body(std::size_t object) const;

  std::unique_ptr<collision::CollisionWorld> collision_;      ///< null without contact
  std::unique_ptr<contact::ContactStepper> contact_stepper_;  ///< null without contact
  std::unique_ptr<contact::DynamicStepper> dynamic_stepper_;  ///< only with contact mode `dynamic`
  contact::ContactLog contacts_;
  /// Data on a movable object in addition to its state.
  struct Object {
    int grasping = 0, pushing = 0;                ///< numbers of tools that grasp and push it
    std::unique_ptr<bodies::FreeBody> free_body;  ///< null while held, asleep or among movable bodies
    std::vector<contact::ContactRow> rows;        ///< contact rows of its last step
    double slow_since = 0.0;                      ///< [s]

    bool carried() const { return grasping + pushing > 0; }
  };
  std::vector<Object> objects_;
  std::set<std::size_t> free_;  ///< objects with a free body, usually few: a step visits only these

 private:
  /// Wakes the objects that have lost their support, and all objects that lie on them.
  void wake_unsupported();

  bodies::TrialStart start_;  ///< start of a step without contact; a member to avoid allocation
};

}  // namespace spring_workbench::objects
