#pragma once

#include <algorithm>
#include <string>

#include "bodies.h"
#include "spring_workbench/simulation/simulation.h"

namespace spring_workbench {

/// Pose of the handle at `p` with the fork pointing down.
inline RigidTransform pointing_down(const Vector3d& p, double turned = 0.0) {
  return make_transform(p, Quaterniond(Eigen::AngleAxisd(turned, Vector3d::UnitZ())) * Quaterniond(0.0, 1.0, 0.0, 0.0));
}

/// Pushes samples at 50 Hz of a handle that moves from `a` to `b` with minimum jerk and turns about the vertical.
inline void push_move(simulation::Simulation& simulation, double t0, double t1, const Vector3d& a, const Vector3d& b,
                      double turn = 0.0, std::size_t hand = 0) {
  for (double t = t0; t < t1 + 1e-9; t += 0.02) {
    const double u = (t - t0) / (t1 - t0);
    const double s = u * u * u * (10.0 + u * (-15.0 + 6.0 * u));
    simulation.push_stylus({t, pointing_down(a + s * (b - a), s * turn)}, hand);
  }
}

inline const bodies::BodyState& object(const simulation::Simulation& simulation, const std::string& name) {
  return *std::find_if(simulation.objects().begin(), simulation.objects().end(),
                       [&](const bodies::BodyState& o) { return o.name == name; });
}

}  // namespace spring_workbench
