// Registers an integrator of our own, Heun's method, and measures its order: how far a swinging box ends from the
// position that the library's integrator gives with very short steps. For a method of order two, half the step gives a
// quarter of the error.
// Usage: own_integrator SCENE.urdf
#include <spring_workbench/spring_workbench.h>

#include <cmath>
#include <cstdio>
#include <memory>

using namespace spring_workbench;

namespace {

/// The explicit trapezoidal rule: an Euler step, then the mean of the slopes at both of its ends.
class Heun : public dynamics::Integrator {
 public:
  int order() const override { return 2; }

  dynamics::StepEstimate step(const dynamics::HeldBody& body, const motion::Trajectory& handle, double t, double h,
                              dynamics::StrainState& state) override {
    const dynamics::StrainState begin = state;
    const rod::StrainVector a = body.acceleration(body.state_at(handle, t), begin.q, begin.q_dot);
    const rod::StrainVector q_euler = begin.q + h * begin.q_dot, q_dot_euler = begin.q_dot + h * a;
    const rod::StrainVector a_euler = body.acceleration(body.state_at(handle, t + h), q_euler, q_dot_euler);
    state.q = begin.q + 0.5 * h * (begin.q_dot + q_dot_euler);
    state.q_dot = begin.q_dot + 0.5 * h * (a + a_euler);
    // The difference between Heun's and Euler's result estimates the error of Euler's method, so it is larger than the
    // error of Heun's.
    dynamics::StepEstimate estimate;
    estimate.q_error = state.q - q_euler;
    estimate.q_dot_error = state.q_dot - q_dot_euler;
    return estimate;
  }
};

/// Returns the position of the box after a second [m], with steps of at most `step` [s]. The hand holds it from the
/// start and moves back and forth sideways.
Vector3d position_after(dynamics::IntegratorKind integrator, double step, const scene::Scene& scene) {
  simulation::SimulationSettings settings;
  settings.contact = scene::ContactMode::none;
  settings.grasp.object = "box";
  settings.fork.stiffness = {400.0, 100.0, 1.0};  // [N/m, N/m, N·m/rad]: soft enough for an explicit method
  settings.fork.damping_ratio = {0.1, 0.1, 0.1};
  settings.dynamics.integrator = integrator;
  settings.dynamics.step = step;
  simulation::Simulation simulation(scene, settings);
  const Quaterniond down(0.0, 1.0, 0.0, 0.0);  // w, x, y, z
  for (int i = 0; i <= 50; ++i) {
    const double t = 0.02 * i;
    simulation.push_stylus({t, make_transform({0.05 * (1.0 - std::cos(6.0 * t)), 0.0, 0.23}, down)});
  }
  simulation.advance_to(1.0);
  return simulation.objects().front().X_WO.translation();
}

}  // namespace

int main(int argc, char** argv) {
  try {
    const dynamics::IntegratorKind heun =
        dynamics::register_integrator("heun", [] { return std::make_unique<Heun>(); });
    const scene::Scene scene = scene::load_scene(argc > 1 ? argv[1] : "../01_lift_a_box/box.urdf");
    const Vector3d reference = position_after(dynamics::IntegratorKind::exponential, 1e-4, scene);

    std::printf("step [ms]  error of heun [m]  observed order\n");
    double last = 0.0;
    for (double step = 1e-3; step > 1e-4; step /= 2.0) {
      const double error = (position_after(heun, step, scene) - reference).norm();
      std::printf("%9.4f  %17.3e", 1e3 * step, error);
      if (last > 0.0) std::printf("  %14.2f", std::log2(last / error));
      std::printf("\n");
      last = error;
    }
  } catch (const validation::InputError& error) {
    std::fprintf(stderr, "own_integrator: %s\n", error.what());
    return 2;
  }
}
