#pragma once

#include <ostream>

#include "spring_workbench/scene/scene.h"

namespace spring_workbench::benchmark {

/// A flat body that is released above the bench and lands almost flush, with restitution 0. Chosen by the seed: shape
/// (box, hull, cylinder, concave mesh), size, friction (0 … 1), tilt (1e-7 … 0.1 rad), step (0.1 … 20 ms), and whether
/// it falls from rest or is thrown down (sideways only without friction). Its height is less than 0.4 of its width: a
/// taller body rocks from edge to edge, and then even the exact impacts lift its centre.
struct Drop {
  scene::ContactMode contact = scene::ContactMode::stop;
  unsigned seed = 0;
};

struct DropResult {
  double tilt = 0.0;          ///< at the start [rad]
  double impact_speed = 0.0;  ///< speed of the centre before the first contact [m/s]
  double leaving =
      0.0;  ///< largest speed of the centre away from the bench after the impact, relative to the impact speed
  double energy_gained = 0.0;  ///< largest increase of energy, relative to that of the impact
  double spin = 0.0;           ///< largest angular speed after the impact [rad/s]
  double depth = 0.0;     ///< largest penetration of the bench after a step, from the exact geometry of the shape [m]
  double rest_gap = 0.0;  ///< distance of the lowest point from the bench at the end [m]
  int steps_blocked = 0;
};

DropResult run(const Drop& drop);

/// Runs the seeds first … first + count − 1 in each mode; writes a CSV row for each mode and shape.
void run_drops(int count, int first, std::ostream& out);

}  // namespace spring_workbench::benchmark
