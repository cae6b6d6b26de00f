#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "spring_workbench/simulation/simulation.h"

namespace spring_workbench::live {

using simulation::ChangeReport;
/// Poses of objects, by name.
using Places = std::map<std::string, RigidTransform>;

/// A change of a simulation that does not come from its hands, recorded so that it can be repeated. A kind ignores the
/// members that it does not need.
struct Command {
  enum class Kind {
    none,         ///< no change, or one that cannot be repeated: only the state after it is known
    select_tool,  ///< select `tool` in `hand`, or else in each
    settings,     ///< apply `fork_change` to `hand`, or else to all, and `dynamics_change`
    calibrate,    ///< calibrate `hand`, or else all hands
    release,      ///< release what `hand`, or else each hand, holds
    clutch,       ///< set the clutch of `hand`, or else of all, to `on`
    restart,      ///< put objects to `places`, all others to their start; nothing is held
    edit,         ///< make `edit`
    load_scene,   ///< load another scene, and keep settings and forks
    reset,        ///< like restart, but can be undone
    undo          ///< undo the last edit or reset
  };
  Command() = default;
  explicit Command(Kind of) : kind(of) {}

  Kind kind = Kind::none;
  std::optional<std::size_t> hand;
  tools::Tool tool = tools::Tool::spring_fork;
  bool on = false;
  simulation::ForkChange fork_change;
  simulation::DynamicsChange dynamics_change;
  Places places;
  simulation::ObjectEdit edit;
  std::vector<std::string> roots;  ///< folders that the edit's URDF may be in; empty if the change is repeated

  /// Returns the command encoded as numbers; empty for Kind::none.
  std::vector<std::uint64_t> words() const;
  /// Decodes the result of words(). Throws InputError if `words` do not encode a command.
  static Command from(const std::vector<std::uint64_t>& words);

 private:
  void archive(math::StateArchive& state);
};

/// Makes a change of any kind except `none`, `edit`, `load_scene` and `undo`. Throws InputError, and changes nothing,
/// if it is impossible.
ChangeReport perform(const Command& command, simulation::Simulation& simulation);

/// Gives the hands of `to`, a simulation of another scene, the forks of the hands of `from`; forks that are calibrated
/// to the world keep the scene's stiffness.
void take_forks(const simulation::Simulation& from, simulation::Simulation& to);

}  // namespace spring_workbench::live
