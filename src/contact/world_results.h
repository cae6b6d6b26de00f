#pragma once

#include <algorithm>
#include <utility>
#include <vector>

#include "constants.h"
#include "spring_workbench/math/so3.h"
#include "spring_workbench/rigid_bodies/rigid_world.h"

namespace spring_workbench::contact {

/// Pose of a driven body at the end of a step, as the world predicts it.
inline RigidTransform predicted_end(const rigid_bodies::DrivenBody& d) {
  Vector6d path = to_vector(d.displacement_W);
  path += d.compliance * to_vector(d.contact_W) + d.displacement_by_impulse * to_vector(d.impact_W);
  RigidTransform end = d.X_WO;
  end.translation() += path.head<3>();
  end.linear() = math::exp_so3(path.tail<3>()) * d.X_WO.linear();
  return end;
}

/// Advances the world by `h` [s], or only until bodies bounce; returns by how much.
inline double step_until_bounce(rigid_bodies::RigidWorld& world, double h,
                                std::vector<rigid_bodies::DrivenBody>& driven) {
  world.step(h, driven);
  if (!(world.first_bounce() < h)) return h;
  const double until_bounce = world.first_bounce();
  world.undo_step();
  world.step(until_bounce, driven);
  return until_bounce;
}

inline void swap_bodies(rigid_bodies::WorldContact& c) {
  std::swap(c.body, c.other);
  c.n_W = -c.n_W;
  c.impulse_W = -c.impulse_W;
}

/// Adds a contact to those of a step, or its impulse to that of the same one.
inline void add_contact(const rigid_bodies::WorldContact& c, std::vector<rigid_bodies::WorldContact>& contacts) {
  const auto same = std::find_if(contacts.begin(), contacts.end(), [&](const rigid_bodies::WorldContact& known) {
    return known.body == c.body && known.other == c.other && known.n_W.dot(c.n_W) > one_normal &&
           (known.p_W - c.p_W).norm() < same_point;
  });
  if (same == contacts.end()) {
    contacts.push_back(c);
    return;
  }
  const Vector3d sum = same->impulse_W + c.impulse_W;
  *same = c;
  same->impulse_W = sum;
}

}  // namespace spring_workbench::contact
