#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "spring_workbench/live/simulation_runner.h"

namespace spring_workbench::live {

/// State from which a program resumes after a crash, as text: the path of the scene and the state of the simulation
/// (simulation::serialise). One instance for each place where it is stored.
class Checkpoint {
 public:
  /// `given_scene`: the scene that the program was started with. `runner` must outlive this object.
  Checkpoint(SimulationRunner& runner, std::string given_scene)
      : runner_(runner), given_scene_(std::move(given_scene)) {}

  /// Calls `write(text)` if the state has changed since the last text. If `write` throws, the next call tries again.
  template <typename Write>
  void keep(Write&& write) {
    std::optional<Kept> now = changed();
    if (!now) return;
    write(text_of(*now));
    kept_ = std::move(*now);
  }
  /// Call if the stored text was lost: the next keep() writes again.
  void forget() { kept_ = Kept(); }

  /// Restores the runner from the text. Throws InputError with `where`, and changes nothing, if the text is damaged or
  /// was written for another `given_scene`. `scene_roots`: as in load_scene().
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

/// A text file that begins with our own header line. A link, folder, FIFO or foreign file at its path is never read in
/// full, replaced or removed. Each function throws InputError with `checkpoint_file`, path and reason.
class CheckpointFile {
 public:
  /// A relative `path` is relative to the working directory (~/.ros for nodes started by roslaunch).
  explicit CheckpointFile(const std::string& path);

  /// The text; empty if there is no file.
  std::string read() const;
  /// Replaces the file atomically (config::OutputFile).
  void write(const std::string& text) const;
  /// Renames the file to PATH.ignored, so that the next write() does not replace it.
  void set_aside() const;
  /// Removes the file, if there is one.
  void remove() const;

 private:
  std::string path_;
};

}  // namespace spring_workbench::live
