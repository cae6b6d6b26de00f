#pragma once

#include <string>
#include <vector>

#include "spring_workbench/scene/scene.h"

namespace spring_workbench::benchmark {

/// Scene of a stress test: what the moved object must not pass through.
enum class StressScene {
  rod_in_room,  ///< a box of 300 × 10 × 10 mm is held in a closed room of 0.5 m whose walls are 1 mm thick
  ring_on_rod   ///< a torus of triangles is held around a fixed rod that extends beyond the hand's reach
};
const std::vector<StressScene>& stress_scenes();
std::string name_of(StressScene scene);

/// One motion: 0.2 s of a hand sampled at 50 Hz at random velocities up to 5 m/s and 50 rad/s, which change after 0.1
/// s.
struct StressMotion {
  StressScene scene = StressScene::rod_in_room;
  scene::ContactMode contact = scene::ContactMode::dynamic;
  unsigned seed = 0;  ///< of the motion, of the pose at the start and of the fork's stiffness (200 … 20 000 N/m)
  double damping_ratio = 1.0;  ///< of the fork
};

struct StressResult {
  double penetration = 0.0;     ///< largest penetration, checked every 2 ms; exact, from the geometry of the shapes [m]
  bool passed_through = false;  ///< whether it was outside, or no longer linked, at the end
  double seconds = 0.0;         ///< processor time
  int steps = 0;
  int steps_blocked = 0;   ///< steps
  double time_lost = 0.0;  ///< time during which the body did not follow its equation [s]
  int rejected = 0;        ///< steps
};

StressResult run(const StressMotion& motion);

}  // namespace spring_workbench::benchmark
