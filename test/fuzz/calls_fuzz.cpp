#include <algorithm>
#include <cmath>
#include <string>

#include "fuzz/choices.h"
#include "fuzz/running.h"
#include "fuzz/targets.h"
#include "spring_workbench/dynamics/integrator.h"
#include "spring_workbench/tools/tool.h"
#include "support/paths.h"

namespace spring_workbench::fuzz {
namespace {

/// Makes one call like the services, with arbitrary numbers.
void call(Choices& next, simulation::Simulation& simulation, motion::PoseSample& hand) {
  simulation::ForkChange fork;
  switch (next.byte() % 11) {
    case 0:
      fork.dofs = {next.flag(), next.flag(), next.flag()};
      simulation.change(fork);
      break;
    case 1: {
      fork.stiffness = next.per_dof();
      simulation.change(fork, {}, next.byte() % 2);
      break;
    }
    case 2:
      (next.flag() ? fork.damping_coefficient : fork.damping_ratio) = next.per_dof();
      fork.damping_law = static_cast<rod::DampingLaw>(next.byte() % 3);
      simulation.change(fork);
      break;
    case 3: {
      simulation::DynamicsChange change;
      change.integrator = static_cast<dynamics::IntegratorKind>(next.byte() % 6);
      const double step = next.number();
      const bool to_tolerance = next.flag();
      // To limit the run time: steps are at least 2 ms, or 50 ms if a tolerance divides them, which is then 1 cm.
      const double shortest = to_tolerance ? 0.05 : 0.002;
      change.step = step > 0.0 ? std::max(step, shortest) : step;
      change.tolerance = to_tolerance ? 0.01 : 0.0;
      simulation.change(fork, change);
      break;
    }
    case 4:
      simulation.select_tool(static_cast<tools::Tool>(next.byte() % 5), next.byte() % 2);
      break;
    case 5:
      simulation.calibrate();
      break;
    case 6:
      simulation.reset();
      break;
    case 7:
      simulation.release();
      break;
    case 8:
      simulation.push_button(hand.t, next.flag(), next.byte() % 2);
      break;
    case 9:
      simulation.push_next_tool(hand.t, next.byte() % 2);
      break;
    default: {
      motion::PoseSample sample = hand;
      sample.t += 0.02 * (1.0 + next.byte() / 64.0);
      for (int i = 0; i < 3; ++i) sample.X.translation()[i] += 0.2 * next.hand_number();
      sample.X.rotate(Eigen::AngleAxisd(next.hand_number(), Vector3d::UnitX()));
      if (simulation.push_stylus(sample, next.byte() % 2)) hand = sample;
    }
  }
}

}  // namespace

void calls(std::string_view bytes) {
  static const scene::Scene scene = scene::load_scene(test_support::checkout("scenes/single_box.urdf"));
  constexpr int max_calls = 60;
  Choices next(bytes);
  simulation::SimulationSettings settings;
  settings.contact = static_cast<scene::ContactMode>(next.byte() % 3);
  simulation::Simulation simulation(scene, settings);
  run_a_hand(simulation);
  motion::PoseSample hand{simulation.newest_sample_time(), simulation.tool().X_WH};
  for (int i = 0; i < max_calls && !next.over(); ++i) {
    const RigidTransform before = simulation.objects()[0].X_WO;
    const double energy = simulation.tool().elastic_energy;
    if (!accepted([&] { call(next, simulation, hand); })) {
      require(simulation.objects()[0].X_WO.matrix() == before.matrix() && simulation.tool().elastic_energy == energy,
              "what is refused changes nothing");
    }
    simulation.advance_to(std::min(simulation.newest_sample_time(), simulation.time() + 0.1));
    check_finite(simulation);
  }
}

}  // namespace spring_workbench::fuzz
