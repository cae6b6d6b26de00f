#pragma once

#include <ostream>

#include "spring_workbench/scene/scene.h"

namespace spring_workbench::benchmark {

/// A body that is thrown at a wall 1 mm thick, without gravity. Chosen by the seed: shape (card of 1 mm, rod, cylinder,
/// concave star), speed (1 … 15 m/s), spin (up to 50 rad/s) about any axis, orientation, restitution (0, or up to 1),
/// and step (10 or 20 ms).
struct Throw {
  scene::ContactMode contact = scene::ContactMode::stop;
  unsigned seed = 0;
  bool loose = false;         ///< the wall is a free plate of 0.5 kg
  bool among_others = false;  ///< a post stands behind the wall's edge, so that more than two bodies are involved
};

struct ThrowResult {
  bool passed_through = false;
  double depth =
      0.0;  ///< largest penetration of the wall's face at the ends of steps, from the exact geometry of the shape [m]
  double energy_gained = 0.0;  ///< largest increase of the total energy, relative to that of the throw
  /// Largest change of the total momentum, and of the angular momentum divided by 1 m, relative to the momentum of the
  /// throw; not used with a fixed wall.
  double momentum_changed = 0.0;
  int steps_blocked = 0, steps_unsolved = 0;
  double seconds = 0.0;  ///< ratio of processor time to simulated time
};

ThrowResult run(const Throw& thrown);

/// Runs the seeds first … first + count − 1; writes a CSV row for each mode, wall and shape.
void run_throws(int count, int first, std::ostream& out);

}  // namespace spring_workbench::benchmark
