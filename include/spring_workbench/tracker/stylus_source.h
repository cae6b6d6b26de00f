#pragma once

#include <memory>
#include <optional>
#include <string>

#include "spring_workbench/motion/pose_track.h"

namespace spring_workbench {

/// A sample of a tracked stylus: `t` [s] since the source's first sample, the pose X of the stylus in the tracker's
/// base frame, and whether the grasp button is down.
struct StylusSample : PoseSample {
  bool button = false;
};

/// Where a stylus comes from: a device, a recording, a script. Stamps are given as they come, repeated and backward
/// ones too (PoseTrack leaves those out).
class StylusSource {
 public:
  virtual ~StylusSource() = default;
  /// The next sample, or nothing when there are no more.
  virtual std::optional<StylusSample> next() = 0;
};

/// A motion from a file: a script (see ScriptedSource) where the name ends in `.yaml` or `.yml`, else a recording (see
/// read_motion_file). Throws InputError as these do.
std::unique_ptr<StylusSource> open_motion(const std::string& path);

}  // namespace spring_workbench
