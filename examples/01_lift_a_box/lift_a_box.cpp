// A hand takes a box off the bench with the spring-fork, which stretches under the box's weight.
// Usage: lift_a_box SCENE.urdf
#include <spring_workbench/spring_workbench.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

using namespace spring_workbench;

namespace {

/// Height of the hand [m] at time `t` [s]: at rest until 0.5 s, 0.1 m higher from 1.5 s on.
double height(double t) { return 0.24 + 0.05 * (1.0 - std::cos(M_PI * std::clamp(t - 0.5, 0.0, 1.0))); }

}  // namespace

int main(int argc, char** argv) {
  try {
    simulation::Simulation simulation(scene::load_scene(argc > 1 ? argv[1] : "box.urdf"), {});

    // The hand, 50 times a second. The fork, 0.2 m long, points along z of the hand: here down, into the box.
    const Quaterniond down(0.0, 1.0, 0.0, 0.0);  // w, x, y, z
    for (int i = 0; i <= 150; ++i) {
      simulation.push_stylus({0.02 * i, make_transform({0.0, 0.0, height(0.02 * i)}, down)});
    }
    simulation.push_button(0.2, true);  // grasps the object that the tip is in

    std::printf("time [s]  hand [m]  box [m]  stretch [mm]  weight [kg]\n");
    for (int i = 0; i <= 15; ++i) {
      simulation.advance_to(0.2 * i);
      const bodies::BodyState& box = simulation.objects().front();
      const tools::ToolState fork = simulation.tool();
      std::printf("%8.1f  %8.4f  %7.4f  %12.3f  %11.4f\n", simulation.time(), fork.X_WS.translation().z(),
                  box.X_WO.translation().z(), 1e3 * fork.stretch, fork.weight);
    }
  } catch (const validation::InputError& error) {
    std::fprintf(stderr, "lift_a_box: %s\n", error.what());
    return 2;
  }
}
