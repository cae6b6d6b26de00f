#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "contact_log.h"
#include "free_body.h"

namespace spring_workbench {

/// The movable objects of a scene: their states, those that fly freely and those that sleep, and what they touch.
/// An object is named by its place in `states()`. A tool takes it with `hold`, carries it, and gives it back with `let_go`.
class Workbench {
 public:
  /// Keeps a reference to `scene`. `bisection_levels`: of the search for contact.
  Workbench(const Scene& scene, int bisection_levels);

  /// All objects back to their start, asleep.
  void reset();

  const std::vector<BodyState>& states() const { return states_; }
  BodyState& state(std::size_t object) { return states_[object]; }
  const Body& body(std::size_t object) const { return scene_.bodies[movable_[object]]; }
  std::size_t scene_index(std::size_t object) const { return movable_[object]; }
  bool massless(std::size_t object) const { return !(body(object).mass_properties.mass > 0.0); }
  void clear_highlights();
  std::optional<std::size_t> find(const std::string& name) const;
  bool with_contact() const { return collision_ != nullptr; }
  /// Whether an object is in free flight: not held and not asleep.
  bool any_free() const;
  ContactLog& contacts() { return contacts_; }
  const ContactLog& contacts() const { return contacts_; }

  /// A tool takes the object at time `now` [s]; what lies on it wakes.
  void hold(std::size_t object, double now);
  /// The object flies on with its twist (`thrown`) or from rest; a massless one stays where it is.
  void let_go(std::size_t object, bool thrown, double now);
  void take_state(std::size_t object, const MotionState& s);

  /// Carries the object over `h` [s] as `stepped` does, with contact where the scene has it.
  void carry(SteppedBody& stepped, std::size_t object, double h, AdvanceReport& report);
  /// Carries all objects in free flight from `now` on; who has been slow for long enough falls asleep.
  void carry_free(double now, double h, AdvanceReport& report);

 private:
  void set_free(std::size_t object, const Twist& V_WO_W, double now);
  void wake_what_lies_on(std::size_t object, double now);
  void put_to_sleep_if_slow(std::size_t object, double now);

  const Scene& scene_;
  std::unique_ptr<CollisionWorld> collision_;  ///< null without contact
  std::unique_ptr<ContactStepper> contact_stepper_;
  ContactLog contacts_;
  // All parallel, one entry for each movable object.
  std::vector<std::size_t> movable_;  ///< index in the scene
  std::vector<BodyState> states_;
  std::vector<std::vector<ContactRow>> rows_;
  std::vector<std::unique_ptr<FreeBody>> free_bodies_;  ///< null while held or asleep
  std::vector<double> slow_since_;                      ///< [s]
};

}  // namespace spring_workbench
