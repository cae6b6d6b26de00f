#include "spring_workbench/live/undo.h"

#include "constants.h"
#include "spring_workbench/validation/input_error.h"

namespace spring_workbench::live {

Places put_to_rest(simulation::Simulation& simulation, double now) {
  Places places;
  for (const bodies::BodyState& object : simulation.objects()) places[object.name] = object.X_WO;
  simulation.reset();
  simulation.advance_to(now);  // without samples this takes no steps
  simulation.reset();
  simulation.place(places);
  return places;
}

std::optional<simulation::Simulation> Undo::prepare(const Command& command,
                                                    const simulation::Simulation& simulation) const {
  if (command.kind == Command::Kind::edit) return simulation.prepare_edit(command.edit, command.roots);
  if (command.kind == Command::Kind::undo) return simulation.prepare_rewind(last().second);
  return std::nullopt;
}

ChangeReport Undo::perform(const Command& command, simulation::Simulation& simulation,
                           std::optional<simulation::Simulation>& next) {
  if (command.kind == Command::Kind::undo)
    return simulation::with_energy_report(simulation, [&] { return take_back(simulation, next); });
  const bool edit = command.kind == Command::Kind::edit;
  if (!edit && command.kind != Command::Kind::reset) return live::perform(command, simulation);
  simulation::SimulationState before = simulation.save();
  ChangeReport report = edit ? simulation.apply_edit(command.edit, next) : live::perform(command, simulation);
  before_.emplace_back(edit ? report.message : "reset", std::move(before));
  if (before_.size() > max_undo_steps) before_.pop_front();
  return report;
}

const Undo::Before& Undo::last() const {
  if (before_.empty()) throw validation::InputError("nothing was edited or reset since the scene was loaded");
  return before_.back();
}

std::string Undo::take_back(simulation::Simulation& simulation, std::optional<simulation::Simulation>& next) {
  simulation.rewind_to(last().second, next);
  std::string undone = std::move(before_.back().first);
  before_.pop_back();
  return undone;
}

}  // namespace spring_workbench::live
