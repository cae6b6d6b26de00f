#pragma once

#include <set>
#include <vector>

#include "spring_workbench/bodies/body_state.h"
#include "spring_workbench/contact/contact_state.h"
#include "spring_workbench/contact/contact_stepper.h"
#include "spring_workbench/rigid_bodies/rigid_world.h"

namespace spring_workbench::contact {

/// A contact of a step of `h` [s] in the world of movable bodies.
ContactRow row_of(const rigid_bodies::WorldContact& contact, double h);

/// Which objects touch which bodies, and since when: the source of `Simulation::contacts`.
class ContactLog {
 public:
  explicit ContactLog(const scene::Scene& scene) : scene_(scene) {}

  /// Forgets all contacts, and prepares for this number of objects.
  void reset(std::size_t objects);
  /// Contacts of one object after a step of `h` [s]. An object without a step keeps its contacts.
  void note(std::size_t object, const bodies::BodyState& state, const std::vector<ContactRow>& rows, double h);
  /// Copies to `object` the contacts that object `its` has in `from`, another scene's log, with bodies of this scene.
  void take(std::size_t object, const ContactLog& from, std::size_t its);
  const std::vector<ContactState>& touching(std::size_t object) const { return touching_[object]; }

  /// Mark the start and the end of a call of Simulation::advance_to(); afterwards reported() returns the contacts of
  /// that call with their phases.
  void begin_call();
  void end_call();
  const std::vector<ContactState>& reported() const { return reported_; }

  /// Saves or restores the contacts, between two calls of Simulation::advance_to().
  void exchange(math::StateArchive& state);

 private:
  std::vector<ContactState> all() const;

  const scene::Scene& scene_;
  std::vector<std::vector<ContactState>> touching_;  ///< by object: contacts after its last step
  std::set<std::size_t> with_contacts_;              ///< objects that touch something
  std::vector<ContactState> before_;                 ///< when the call began
  std::vector<ContactState> ended_;                  ///< ended in the present call
  std::vector<ContactState> reported_;
};

}  // namespace spring_workbench::contact
