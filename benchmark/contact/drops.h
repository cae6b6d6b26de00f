#pragma once

#include <ostream>

#include "spring_workbench/scene/scene.h"

namespace spring_workbench::benchmark {

/// A flat thing that is let go above the bench and lands almost flush, with restitution 0. By its seed: its shape (box,
/// hull, cylinder, concave mesh), size, friction (0 … 1) and tilt (1e-7 … 0.1 rad), the step (0.1 … 20 ms), and whether
/// it falls from rest or is thrown down; thrown across only without friction. Its height is less than 0.4 of its
/// width: what is higher rocks from edge to edge, and then the exact impacts send its centre up, too.
struct Drop {
  scene::ContactMode contact = scene::ContactMode::stop;
  unsigned seed = 0;
};

struct DropResult {
  double tilt = 0.0;           ///< at the start [rad]
  double impact_speed = 0.0;   ///< of the centre before the first contact [m/s]
  double leaving = 0.0;        ///< largest speed of the centre away from the bench after it, over the impact speed
  double energy_gained = 0.0;  ///< largest rise of the energy, over that of the impact speed
  double spin = 0.0;           ///< largest speed at which it turns after the impact [rad/s]
  double depth = 0.0;          ///< largest below the bench, after each step, from the shape's own geometry [m]
  double rest_gap = 0.0;       ///< distance of the lowest point from the bench at the end [m]
  int steps_blocked = 0;
};

DropResult run(const Drop& drop);

/// Runs seeds first … first + count − 1 with each mode: a CSV line for each mode and shape.
void run_drops(int count, int first, std::ostream& out);

}  // namespace spring_workbench::benchmark
