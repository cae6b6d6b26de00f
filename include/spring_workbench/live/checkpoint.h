#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "spring_workbench/live/simulation_runner.h"

namespace spring_workbench::live {

/// State from which a program continues when it is restarted after a crash, as text: the scene's path and the state
/// of the simulation (simulation::serialise). One for each place where it is kept.
class Checkpoint {
 public:
  /// `given_scene`: what the program was told to begin with. `runner` must outlive this.
  Checkpoint(SimulationRunner& runner, std::string given_scene)
      : runner_(runner), given_scene_(std::move(given_scene)) {}

  /// Calls `write(text)` if the state is not that of the last text. If `write` throws, the next call does it again.
  template <typename Write>
  void keep(Write&& write) {
    std::optional<Kept> now = changed();
    if (!now) return;
    write(text_of(*now));
    kept_ = std::move(*now);
  }
  /// The place is empty: the next keep() writes.
  void forget() { kept_ = Kept(); }

  /// Brings the runner to what the text says. Throws InputError with `where`, and changes nothing, if it is damaged or
  /// of another given scene. `scene_roots`: as of load_scene().
  void resume(const std::string& text, const std::string& where, const std::vector<std::string>& scene_roots);

 private:
  struct Kept {
    std::string scene;  ///< path; empty: nothing is kept
    simulation::SimulationState state;
  };
  std::optional<Kept> changed() const;
  std::string text_of(const Kept& kept) const;

  SimulationRunner& runner_;
  std::string given_scene_;
  Kept kept_;
};

/// A text in a file that begins with a line of ours. A link, a folder, a FIFO or somebody else's file at its path is
/// never read in full, replaced or removed. Each throws InputError with `checkpoint_file`, path and reason.
class CheckpointFile {
 public:
  /// `path`: a relative one counts from the working folder (of roslaunch's nodes, ~/.ros).
  explicit CheckpointFile(const std::string& path);

  /// The text; empty if there is no file.
  std::string read() const;
  /// Replaces the whole file, or leaves it as it is; a file that is there is never cut short (config::OutputFile).
  void write(const std::string& text) const;
  /// Renames the file to PATH.ignored, so that the next write() does not replace it.
  void set_aside() const;
  /// Removes the file, if there is one.
  void remove() const;

 private:
  std::string path_;
};

}  // namespace spring_workbench::live
