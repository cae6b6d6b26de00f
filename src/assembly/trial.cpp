#include "spring_workbench/assembly/trial.h"

#include <algorithm>
#include <vector>

#include "spring_workbench/hand_input/input_filter.h"
#include "spring_workbench/tools/tool.h"

namespace spring_workbench::assembly {

OperatorView operator_view(const simulation::Simulation& simulation) {
  OperatorView view;
  view.objects = simulation.objects();
  for (std::size_t hand = 0; hand < simulation.hands(); ++hand) {
    const tools::ToolState tool = simulation.tool(hand);
    view.tools.push_back({RigidTransform::Identity(), tools::turns_object(tool.tool), tool.held_object});
    view.tools.back().X_HE.translation().z() = tool.length;
  }
  return view;
}

simulation::SimulationSettings with_all_hands(const scene::Scene& scene, simulation::SimulationSettings settings) {
  settings.styluses = std::max(settings.styluses, static_cast<int>(scene.X_WH_start.size()));
  return settings;
}

Trial run_trial(const scene::Scene& scene, const simulation::SimulationSettings& simulation_settings,
                const OperatorSettings& operator_settings, double time_limit) {
  simulation::Simulation simulation(scene, with_all_hands(scene, simulation_settings));
  hand_input::InputFilter filter(simulation, hand_input::InputSettings());
  TaskMonitor monitor(simulation.scene());
  SimulatedOperator person(simulation.scene(), operator_settings, [&] { return operator_view(simulation); });
  Trial trial;
  std::vector<bool> pressed(person.hands(), false);
  double before = 0.0;  // time of the previous samples [s]
  while (const std::optional<motion::StylusSample> sample = person.next()) {
    if (sample->t > time_limit) break;
    filter.push_stylus(*sample, sample->hand);
    if (sample->button != pressed[sample->hand]) filter.push_button(sample->t, sample->button, sample->hand);
    pressed[sample->hand] = sample->button;
    trial.motion.push_back(*sample);
    if (sample->hand + 1 < person.hands()) continue;
    if (sample->t > 0.0) {
      trial.steps_rejected += filter.advance_to(before).steps_rejected;
      monitor.observe(simulation);
    }
    before = sample->t;
  }
  trial.score = monitor.score();
  trial.placements = monitor.placements();
  return trial;
}

}  // namespace spring_workbench::assembly
