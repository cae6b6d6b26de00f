#include "spring_workbench/assembly/trial.h"

#include "spring_workbench/hand_input/feed.h"
#include "spring_workbench/tools/tool.h"

namespace spring_workbench::assembly {

OperatorView look_at(const simulation::Simulation& simulation) {
  const tools::ToolState tool = simulation.fork();
  OperatorView view;
  view.objects = simulation.objects();
  view.X_HE.translation().z() = tool.length;
  view.turns = tools::turns(tool.tool);
  return view;
}

Trial run_trial(const scene::Scene& scene, const simulation::SimulationSettings& simulation_settings,
                const OperatorSettings& operator_settings, double time_limit) {
  simulation::Simulation simulation(scene, simulation_settings);
  hand_input::Feed feed(simulation, hand_input::InputSettings());
  TaskMonitor monitor(simulation.scene());
  SimulatedOperator hand(simulation.scene(), operator_settings, [&] { return look_at(simulation); });
  Trial trial;
  bool pressed = false;
  while (const std::optional<motion::StylusSample> sample = hand.next()) {
    if (sample->t > time_limit) break;
    feed.push_stylus(*sample);
    if (sample->button != pressed) feed.push_button(sample->t, sample->button);
    pressed = sample->button;
    if (!trial.motion.empty()) {
      trial.steps_rejected += feed.advance_to(trial.motion.back().t).steps_rejected;
      monitor.observe(simulation);
    }
    trial.motion.push_back(*sample);
  }
  trial.score = monitor.score();
  trial.placements = monitor.placements();
  return trial;
}

}  // namespace spring_workbench::assembly
