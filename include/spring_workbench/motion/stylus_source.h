#pragma once

#include <optional>
#include <string>
#include <vector>

#include "spring_workbench/math/state_archive.h"
#include "spring_workbench/motion/pose_track.h"

namespace spring_workbench::motion {

/// A sample of a tracked stylus. `t` is the time since the first sample of the source [s], and `X` is the pose of the
/// stylus in the tracker's base frame.
struct StylusSample : PoseSample {
  bool button = false;           ///< whether the grasp button is down
  std::size_t hand = 0;          ///< number of the hand, from 0
  double quaternion_norm = 1.0;  ///< length of the quaternion from which `X` was made, for hand_input::InputFilter
};

/// A button edge of a stylus: a button is pressed or released.
enum class ButtonEdge {
  grasp,       ///< the grasp button goes down
  release,     ///< the grasp button goes up
  next_tool,   ///< the second button goes down
  clutch_on,   ///< the clutch button goes down
  clutch_off,  ///< the clutch button goes up
};

/// Measurement of a machine's force sensor: a wrench on the held object at the tip E.
struct ExternalWrench {
  /// Axes of the wrench.
  enum class Axes {
    world,  ///< those of world
    tip,    ///< those of the tip, which turn with it
  };
  double t = 0.0;           ///< time of the measurement [s]
  Wrench wrench;            ///< wrench about the origin of E [N, N·m], each component within ±1e5
  Axes axes = Axes::world;  ///< axes in which `wrench` is given

  /// Saves or restores all fields.
  void archive(math::StateArchive& state) { state(t, wrench, axes); }
};
/// The words for the axes in messages and in Python.
inline std::vector<std::string> names_of(ExternalWrench::Axes) { return {"world", "tip"}; }

/// Throws InputError, with `where`, field, value and rule, if a component is not finite or out of range.
void validate(const ExternalWrench& sample, const std::string& where);

/// Source of stylus samples: a device, a recording or a script. Times count from its first sample. Those that repeat or
/// go backward are passed on, too; PoseTrack ignores such samples.
class StylusSource {
 public:
  virtual ~StylusSource() = default;
  /// Returns the next sample, or nothing at the end of the source.
  virtual std::optional<StylusSample> next() = 0;
};

}  // namespace spring_workbench::motion
