#pragma once

#include <string>

#include "spring_workbench/math/state_archive.h"

namespace spring_workbench::contact {

/// Phase of a contact with respect to the last call of Simulation::advance_to(), in which it may have started or ended.
enum class ContactPhase { started, persisting, ended };

/// One contact point of an object with another body.
struct ContactState {
  std::string object;                ///< name of the object
  std::string other;                 ///< name of the other body; "workbench": the bench
  Vector3d p_W = Vector3d::Zero();   ///< contact point in world [m]
  Vector3d n_W = Vector3d::UnitZ();  ///< unit normal of the surface, towards `object`, world axes
  double depth = 0.0;                ///< depth of penetration along the normal [m]
  double impulse = 0.0;              ///< normal impulse in the last step [N·s]
  /// This point's share of the normal force between the two bodies, as a mean over the last 20 ms, however long the
  /// steps are [N]. Once the contact has ended, the force is the share in its last step.
  double force = 0.0;
  double slip_speed = 0.0;                     ///< speed of `object` along `other`'s surface [m/s]
  ContactPhase phase = ContactPhase::started;  ///< phase of the contact

  /// Saves or restores all fields.
  void archive(math::StateArchive& state) { state(object, other, p_W, n_W, depth, impulse, force, slip_speed, phase); }
};

}  // namespace spring_workbench::contact
