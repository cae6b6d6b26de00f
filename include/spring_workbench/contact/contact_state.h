#pragma once

#include <string>

#include "spring_workbench/math/state_archive.h"

namespace spring_workbench::contact {

/// Phase of a contact.
enum class ContactPhase { started, persisting, ended };

/// A contact of an object, in world axes.
struct ContactState {
  std::string object;                ///< the object's name
  std::string other;                 ///< the other body's name; "workbench": the bench
  Vector3d p_W = Vector3d::Zero();   ///< contact point [m]
  Vector3d n_W = Vector3d::UnitZ();  ///< unit normal, towards `object`
  double depth = 0.0;                ///< penetration [m]
  double impulse = 0.0;              ///< normal impulse in the last step [N·s]
  double force = 0.0;  ///< its share of the mean normal force between the two bodies over the last 20 ms, however long
                       ///< the steps are [N]; once ended, that of its last step
  double slip_speed = 0.0;                     ///< speed of `object` along the surface [m/s]
  ContactPhase phase = ContactPhase::started;  ///< started, persisting or ended in the last call of
                                               ///< Simulation::advance_to()

  /// Saves or restores all fields.
  void exchange(math::StateArchive& state) { state(object, other, p_W, n_W, depth, impulse, force, slip_speed, phase); }
};

}  // namespace spring_workbench::contact
