#pragma once

#include <map>
#include <set>
#include <string>
#include <vector>

#include "spring_workbench/bodies/body_state.h"
#include "spring_workbench/contact/contact_state.h"
#include "spring_workbench/contact/contact_stepper.h"
#include "spring_workbench/rigid_bodies/rigid_world.h"

namespace spring_workbench::contact {

/// Converts a contact of the world of movable bodies after a step of `h` [s].
ContactRow row_of(const rigid_bodies::WorldContact& contact, double h);

/// Which objects touch which bodies, and since when: the source of `Simulation::contacts`.
class ContactLog {
 public:
  explicit ContactLog(const scene::Scene& scene);

  /// Forgets all contacts, and prepares for this number of objects.
  void reset(std::size_t objects);
  /// Begins a step of `h` [s] of all objects: the impulses before it are that much older.
  void begin_step(double h);
  /// Contacts of one object after a step of `h` [s]; `states`: of all objects. An object without a step keeps its
  /// contacts.
  void note(std::size_t object, const std::vector<bodies::BodyState>& states, const std::vector<ContactRow>& rows,
            double h);
  /// Copies to `object` the contacts that object `its` has in `from`, another scene's log, with bodies of this scene.
  void copy(std::size_t object, const ContactLog& from, std::size_t its);
  const std::vector<ContactState>& touching(std::size_t object) const { return touching_[object]; }

  /// Mark the start and the end of a call of Simulation::advance_to(); afterwards reported() returns the contacts of
  /// that call with their phases.
  void begin_call();
  void end_call();
  const std::vector<ContactState>& reported() const { return reported_; }

  /// Saves or restores the contacts, between two calls of Simulation::advance_to().
  void archive(math::StateArchive& state);

 private:
  /// Normal impulse between an object and another body in a step of `h`, which ended `age` before now [N·s, s].
  struct PastImpulse {
    std::string other;
    double impulse = 0.0, h = 0.0, age = 0.0;
    void archive(math::StateArchive& state) { state(other, impulse, h, age); }
  };
  /// Notes the impulses of a step of `h` of `object`, whose contacts these are, and sets their forces [s].
  void set_forces(std::size_t object, double h, std::vector<ContactState>& contacts);
  std::vector<ContactState> all() const;

  const scene::Scene& scene_;
  std::vector<std::size_t> object_of_;                      ///< object by index in the scene; valid for movable bodies
  std::vector<std::vector<ContactState>> touching_;         ///< by object: contacts after its last step
  std::set<std::size_t> with_contacts_;                     ///< objects that touch something
  std::map<std::size_t, std::vector<PastImpulse>> recent_;  ///< by object: those within the window of the forces
  std::vector<ContactState> before_;                        ///< when the call began
  std::vector<ContactState> ended_;                         ///< ended in the present call
  std::vector<ContactState> reported_;
};

}  // namespace spring_workbench::contact
