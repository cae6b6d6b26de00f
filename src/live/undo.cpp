#include "spring_workbench/live/undo.h"

#include "constants.h"
#include "spring_workbench/validation/input_error.h"

namespace spring_workbench::live {

Places put_to_rest(simulation::Simulation& simulation, double now) {
  Places places;
  for (const bodies::BodyState& object : simulation.objects()) places[object.name] = object.X_WO;
  simulation.reset();
  simulation.advance(now);  // without samples this takes no steps
  simulation.reset();
  simulation.place(places);
  return places;
}

ChangeReport Undo::perform(const Command& command, simulation::Simulation& simulation) {
  if (command.kind == Command::Kind::undo)
    return simulation::reported(simulation, [&] { return take_back(simulation); });
  const bool reset = command.kind == Command::Kind::reset;
  if (!reset && command.kind != Command::Kind::edit) return live::perform(command, simulation);
  simulation::SimulationState before = simulation.save();
  ChangeReport report = live::perform(command, simulation);
  before_.emplace_back(reset ? "reset" : report.message, std::move(before));
  if (before_.size() > max_undo_steps) before_.pop_front();
  return report;
}

std::string Undo::take_back(simulation::Simulation& simulation) {
  if (before_.empty()) throw validation::InputError("nothing was edited or reset since the scene was loaded");
  simulation.go_back_to(before_.back().second);
  std::string undone = std::move(before_.back().first);
  before_.pop_back();
  return undone;
}

}  // namespace spring_workbench::live
