#include "spring_workbench/live/command.h"

#include <algorithm>
#include <stdexcept>

#include "spring_workbench/validation/names.h"

namespace spring_workbench::live {
namespace {

std::string release(const Command& command, simulation::Simulation& simulation) {
  std::vector<std::string> names;
  for (std::size_t hand = 0; hand < simulation.hands(); ++hand) {
    if (command.hand.value_or(hand) != hand) continue;
    const std::string name = simulation.tool(hand).held_object;
    if (simulation.release(hand) && std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
  }
  if (names.empty()) throw validation::InputError("no object is held, so there is nothing to release");
  return "released " + validation::join(names);
}

std::string clutch(const Command& command, simulation::Simulation& simulation) {
  for (std::size_t hand = 0; hand < simulation.hands(); ++hand) {
    if (command.hand.value_or(hand) == hand) simulation.push_clutch(simulation.time(), command.on, hand);
  }
  return command.on ? "on: the hand moves without the tool" : "off: the tool follows the hand";
}

/// Makes the change and returns the message.
std::string make(const Command& command, simulation::Simulation& simulation) {
  switch (command.kind) {
    case Command::Kind::select_tool:
      return simulation.select_tool(command.tool, command.hand).message;
    case Command::Kind::settings:
      return simulation.change(command.fork_change, command.dynamics_change, command.hand).message;
    case Command::Kind::calibrate:
      return simulation.calibrate(command.hand).message;
    case Command::Kind::release:
      return release(command, simulation);
    case Command::Kind::clutch:
      return clutch(command, simulation);
    case Command::Kind::restart:
    case Command::Kind::reset:
      simulation.reset();
      simulation.place(command.places);
      return "all objects are back at their start poses";
    case Command::Kind::none:
    case Command::Kind::edit:
    case Command::Kind::load_scene:
    case Command::Kind::undo:
      break;
  }
  validation::refuse("command", "kind", std::to_string(static_cast<int>(command.kind)),
                     "a change within the current scene (not none, edit, load_scene or undo)");
}

}  // namespace

std::vector<std::uint64_t> Command::words() const {
  if (kind == Kind::none) return {};
  math::StateArchive archive;
  Command(*this).archive(archive);
  return std::move(archive).words();
}

Command Command::from(const std::vector<std::uint64_t>& words) {
  Command command;
  if (words.empty()) return command;
  math::StateArchive archive(words);
  try {
    command.archive(archive);
    if (archive.at_end()) return command;
  } catch (const std::out_of_range&) {
  }
  validation::refuse(
      "", "command",
      "one that was recorded in ~changes, got " + std::to_string(words.size()) + " words that cannot be decoded");
}

void Command::archive(math::StateArchive& state) {
  state(kind, hand, tool, on, places);
  state(fork_change.dofs, fork_change.stiffness, fork_change.damping_ratio, fork_change.damping_coefficient,
        fork_change.damping_law, fork_change.damping);
  state(dynamics_change.integrator, dynamics_change.step, dynamics_change.tolerance, edit);
}

ChangeReport perform(const Command& command, simulation::Simulation& simulation) {
  return simulation::with_energy_report(simulation, [&] { return make(command, simulation); });
}

void take_forks(const simulation::Simulation& from, simulation::Simulation& to) {
  for (std::size_t hand = 0; hand < to.hands(); ++hand) {
    rod::ForkChange change = rod::change_to(from.fork_settings(hand));
    if (to.settings().grasp.calibrate == tools::Calibration::world) change.stiffness = {};
    to.change(change, {}, hand);
  }
}

}  // namespace spring_workbench::live
