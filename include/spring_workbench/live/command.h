#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "spring_workbench/simulation/simulation.h"

namespace spring_workbench::live {

/// A change of a simulation by other means than its hands, so that it can be made again. What a kind does not need is
/// ignored.
struct Command {
  enum class Kind {
    none,         ///< no change, or one that is not made again: only the state after it is known
    select_tool,  ///< `tool`, of `hand` or else the first
    settings,     ///< `of_fork`, of `hand` or else of all; with `of_dynamics`, of all
    calibrate,    ///< of `hand`, or else of all
    release,      ///< the same
    clutch,       ///< the same, to `on`
    restart,      ///< objects at `places`, the others at their start; nothing held
    edit,         ///< `edit`
    load_scene,   ///< another scene, with the settings and forks of the present
    reset,        ///< restart, to be taken back
    undo          ///< the last edit or reset is taken back
  };
  Kind kind = Kind::none;
  std::optional<std::size_t> hand;
  tools::Tool tool = tools::Tool::spring_fork;
  bool on = false;
  simulation::ForkChange of_fork;
  simulation::DynamicsChange of_dynamics;
  std::map<std::string, RigidTransform> places;
  simulation::ObjectEdit edit;
  std::vector<std::string> roots;  ///< of the edit's URDF; none where it is made again

  /// As numbers, and back; none for Kind::none. Throws InputError for words that are no command.
  std::vector<std::uint64_t> words() const;
  static Command from(const std::vector<std::uint64_t>& words);

 private:
  void exchange(math::StateArchive& state);
};

/// Makes the change, of any kind but `none`, `load_scene` and `undo`. Throws InputError, and changes nothing, where it
/// cannot be made.
simulation::ChangeReport perform(const Command& command, simulation::Simulation& simulation);

/// Of each hand.
std::vector<rod::ForkSettings> forks_of(const simulation::Simulation& simulation);

/// Of a scene, each hand with its fork; the stiffness of forks that are calibrated to the world is the scene's. Throws
/// InputError where the settings do not fit the scene.
simulation::Simulation make_simulation(const scene::Scene& scene, const simulation::SimulationSettings& settings,
                                       const std::vector<rod::ForkSettings>& forks);

}  // namespace spring_workbench::live
