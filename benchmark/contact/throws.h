#pragma once

#include <ostream>

#include "spring_workbench/scene/scene.h"

namespace spring_workbench::benchmark {

/// A thing that is thrown at a wall 1 mm thick, without gravity. By its seed: its shape (card of 1 mm, rod, cylinder,
/// concave star), speed (1 … 15 m/s) and spin (to 50 rad/s) about any axis, how it is turned, restitution (0, or up to
/// 1), and the step (10 or 20 ms).
struct Throw {
  scene::ContactMode contact = scene::ContactMode::stop;
  unsigned seed = 0;
  bool loose = false;         ///< the wall is a movable plate of 0.5 kg that nobody holds
  bool among_others = false;  ///< a post stands behind the wall's edge, so that there are more than two
};

struct ThrowResult {
  bool passed_through = false;
  double depth = 0.0;  ///< largest beyond the wall's face, at the ends of steps, from the shape's own geometry [m]
  double energy_gained = 0.0;  ///< largest rise of the energy of both, over that of the throw
  /// Largest change of the momentum of both, and of their angular momentum over 1 m, over the momentum of the throw;
  /// none with a fixed wall.
  double momentum_changed = 0.0;
  int steps_blocked = 0, steps_unsolved = 0;
  double seconds = 0.0;  ///< processor time over simulated time
};

ThrowResult run(const Throw& thrown);

/// Runs seeds first … first + count − 1: a CSV line for each mode, wall and shape.
void run_throws(int count, int first, std::ostream& out);

}  // namespace spring_workbench::benchmark
