#pragma once

#include <cstdint>
#include <string>

#include "spring_workbench/math/state_archive.h"

namespace spring_workbench::simulation {

/// All of a simulation that its calls change, between two of them: what its future depends on beside its scene and the
/// settings that it was made with. A value, by which a simulation of the same scene and settings goes on bit by bit as
/// the one that was saved (`Simulation::save`, `Simulation::restore`).
class SimulationState {
 public:
  /// Of no simulation.
  SimulationState() = default;

  /// Of all its numbers; the same on every machine.
  std::uint64_t hash() const { return math::hash(words_); }
  bool operator==(const SimulationState& other) const { return scene_ == other.scene_ && words_ == other.words_; }
  bool operator!=(const SimulationState& other) const { return !(*this == other); }

 private:
  friend class Simulation;
  friend std::string serialise(const SimulationState& state);
  friend SimulationState parse_state(const std::string& text);

  std::string scene_;  ///< what must be the same in a simulation that goes on from here
  math::StateArchive::Words words_;
};

/// As one YAML text, which another process can parse: every number with all its bits.
std::string serialise(const SimulationState& state);

/// Throws InputError for what is no such text, or one with a hash that is not its numbers'.
SimulationState parse_state(const std::string& text);

/// A hash as 16 hexadecimal digits.
std::string to_hex(std::uint64_t hash);

}  // namespace spring_workbench::simulation
