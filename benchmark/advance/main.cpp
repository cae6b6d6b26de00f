// A fork in use, step by step; scripts/count_instructions counts the instructions of Simulation::advance_to with it, or
// of a copy that looks ahead.
#include <cmath>
#include <cstdlib>
#include <iostream>
#include <string>

#include "spring_workbench/simulation/simulation.h"
#include "spring_workbench/validation/input_error.h"

namespace spring_workbench {
namespace {

constexpr double interval = 0.02;  ///< [s] between samples of the hand; one step per sample
constexpr int steps_before = 100;  ///< steps until the object is in position

constexpr char usage[] =
    "advance_steps SCENE.urdf none|free|pressed|ahead STEPS\n\n"
    "Carries the scene's object `box` with the default fork on a hand sampled at 50 Hz, by one call of\n"
    "Simulation::advance_to for each of STEPS samples after the first 100. none: without contact; free: contact mode\n"
    "`stop` with nothing near; pressed: on the bench, pressed down by about 2 N beyond its weight and dragged; ahead:\n"
    "as free, and a copy, as for the display, follows each step and advances 12 ms beyond it. Prints the steps taken,\n"
    "and those with contacts, of the last STEPS.\n";

/// A hand that moves smoothly along a slanted figure of 0.1 m; `height` [m]: height of the fork's tip, constant if
/// `level`.
RigidTransform hand_at(double t, double height, bool level) {
  const double rises = level ? 0.0 : 0.05 * std::sin(5.0 * t), turned = level ? 0.0 : 0.3;
  const Quaterniond R = Quaterniond(Eigen::AngleAxisd(turned * std::sin(3.0 * t), Vector3d(0.6, 0.0, 0.8))) *
                        Quaterniond(0.0, 1.0, 0.0, 0.0);
  return make_transform(Vector3d(0.1 * std::sin(4.0 * t), 0.05 * std::sin(6.0 * t), height + 0.2 + rises), R);
}

/// Takes over the state of `simulation` and advances to `t` [s], where the hand is known up to the sample `next`.
[[gnu::noinline]] void look_ahead(simulation::Simulation& copy, const simulation::Simulation& simulation,
                                  const motion::PoseSample& next, double t) {
  copy.copy_state_from(simulation);
  copy.push_stylus(next);
  copy.advance_to(t);
}

int run(const std::string& path, const std::string& name, int steps) {
  const bool pressed = name == "pressed";
  simulation::SimulationSettings settings;
  settings.contact = name == "none" ? scene::ContactMode::none : scene::ContactMode::stop;
  settings.grasp.object = "box";
  settings.grasp.X_OE = make_transform(Vector3d::Zero(), Quaterniond(0.0, 1.0, 0.0, 0.0));
  settings.grasp.start_follow = true;
  simulation::Simulation simulation(scene::load_scene(path), settings), copy(scene::load_scene(path), settings);
  const double held = simulation.objects().front().X_WO.translation().z();
  long taken = 0, touching = 0;
  for (int i = 0; i < steps_before + steps + 2; ++i) {
    const double t = i * interval, lowered = pressed ? std::min(1.0, t) : 0.0;
    const double height = pressed ? held + 0.02 - 0.021 * lowered : held + 0.5;
    simulation.push_stylus({t, hand_at(t, height, pressed)});
    if (i < 2) continue;  // the hand is known two samples ahead
    const simulation::AdvanceReport report = simulation.advance_to((i - 1) * interval);
    if (name == "ahead")
      look_ahead(copy, simulation, {t + interval, hand_at(t + interval, height, pressed)}, t - 0.4 * interval);
    if (i < steps_before + 2) continue;
    taken += report.steps;
    touching += simulation.objects().front().in_contact ? 1 : 0;
  }
  std::cout << taken << ' ' << touching << '\n';
  return 0;
}

int run(int count, char** arguments) {
  const std::string name = count == 4 ? arguments[2] : "";
  const int steps = count == 4 ? std::atoi(arguments[3]) : -1;
  if ((name != "none" && name != "free" && name != "pressed" && name != "ahead") || steps < 0 || steps > 1000000) {
    std::cerr << usage;
    return 2;
  }
  try {
    return run(arguments[1], name, steps);
  } catch (const validation::InputError& e) {
    std::cerr << e.what() << '\n';
    return 2;
  }
}

}  // namespace
}  // namespace spring_workbench

int main(int argc, char** argv) { return spring_workbench::run(argc, argv); }
