#pragma once

#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "spring_workbench/bodies/free_body.h"
#include "spring_workbench/contact/contact_log.h"
#include "spring_workbench/contact/dynamic_stepper.h"
#include "spring_workbench/simulation/simulation.h"

namespace spring_workbench::simulation {

/// Body that a tool carries over a step.
struct Carried {
  std::size_t object;  ///< in the workbench
  bodies::SteppedBody* body;
};

/// The movable objects of a scene: their states, those that fly freely and those that sleep, and what they touch.
/// An object is named by its place in `states()`. A tool takes it with `hold`, carries it, and gives it back with
/// `let_go`.
class Objects {
 public:
  /// Keeps a reference to `scene`. `bisection_levels`: of the search for contact.
  Objects(const scene::Scene& scene, int bisection_levels);

  /// Puts all objects back to their initial poses, asleep.
  void reset();

  const std::vector<bodies::BodyState>& states() const { return states_; }
  bodies::BodyState& state(std::size_t object) { return states_[object]; }
  const scene::Body& body(std::size_t object) const { return scene_.bodies[objects_[object].body]; }
  std::size_t scene_index(std::size_t object) const { return objects_[object].body; }
  bool massless(std::size_t object) const { return !(body(object).mass_properties.mass > 0.0); }
  void clear_highlights();
  void highlight(std::size_t object);
  std::optional<std::size_t> find(const std::string& name) const;
  bool with_contact() const { return scene_.contact != scene::ContactMode::none; }
  /// Whether an object is in free flight: not held and not asleep.
  bool any_free() const;
  contact::ContactLog& contacts() { return contacts_; }
  const contact::ContactLog& contacts() const { return contacts_; }

  enum class Grip { grasp, push };
  /// A tool takes the object, or begins to push it, at time `now` [s]; what lies on it wakes.
  void hold(std::size_t object, Grip grip, double now);
  /// A tool that took the object leaves it. After the last one it flies on with its twist (`thrown`) or from rest; a
  /// massless one stays where it is.
  void let_go(std::size_t object, Grip grip, bool thrown, double now);
  void take_state(std::size_t object, const motion::MotionState& s);
  /// Puts an object that no tool has somewhere, at rest; it falls from there.
  void place(std::size_t object, const RigidTransform& X_WO, double now);

  /// Wakes the sleeping objects that rest on `object`, directly or on one another.
  void wake_what_lies_on(std::size_t object, double now);
  /// Returns whether nothing moves that a held object could touch.
  bool rests(std::size_t object) const;

  /// Carries held and free objects over `h` [s] from `now` on, with the contact mode of the scene. An object that has
  /// been slow for long enough falls asleep.
  void step(const std::vector<Carried>& held, double now, double h, AdvanceReport& report);

  /// Between two calls of `advance`.
  void exchange(math::StateArchive& state);

 private:
  /// Contact mode `dynamic`: what only fixed bodies are near, held or free, is carried as with `stop`, all the rest in
  /// one world.
  void step_among_movable(const std::vector<Carried>& held, double now, double h, AdvanceReport& report);
  void step_together(const std::vector<Carried>& held, const std::vector<std::size_t>& moving, double now, double h,
                     AdvanceReport& report);
  void note_world_contacts(double h);
  /// Returns false, and does nothing, if `may_go` forbids the motion.
  bool carry(bodies::SteppedBody& stepped, std::size_t object, double h, const contact::ContactStepper::MayGo& may_go,
             AdvanceReport& report);
  /// On its way from its state, without a tool; a massless one stays.
  void let_fly(std::size_t object, double now);
  void set_free(std::size_t object, const Twist& V_WO_W, double now);
  void put_to_sleep_if_slow(std::size_t object, double now);
  bool touches_what_moves(std::size_t object) const;

  const scene::Scene& scene_;
  std::unique_ptr<collision::CollisionWorld> collision_;      ///< null without contact
  std::unique_ptr<contact::ContactStepper> contact_stepper_;  ///< likewise
  std::unique_ptr<contact::DynamicStepper> dynamic_stepper_;  ///< of contact mode `dynamic` alone
  contact::ContactLog contacts_;
  std::vector<bodies::BodyState> states_;  ///< what others see of `objects_`, one for each
  /// A movable object.
  struct Object {
    std::size_t body = 0;                         ///< index in the scene
    int grasping = 0, pushing = 0;                ///< tools that carry it
    std::unique_ptr<bodies::FreeBody> free_body;  ///< null while held, asleep or among movable bodies
    std::vector<contact::ContactRow> rows;        ///< of its last step
    double slow_since = 0.0;                      ///< [s]
  };
  std::vector<Object> objects_;
  std::vector<std::size_t> object_of_;  ///< by index in the scene; means something for movable bodies
  bodies::TrialStart start_;            ///< of a step without contact; no allocation there
  // Few of many: a step looks at no others.
  std::vector<std::size_t> highlighted_;
  std::set<std::size_t> free_;        ///< those with a free body
  std::set<std::size_t> in_contact_;  ///< with contact mode `dynamic`
};

}  // namespace spring_workbench::simulation
