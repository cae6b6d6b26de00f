#pragma once

#include <optional>

#include "spring_workbench/motion/pose_track.h"

namespace spring_workbench::motion {

/// A sample of a tracked stylus: `t` [s] since the source's first sample, the pose X of the stylus in the tracker's
/// base frame, and whether the grasp button is down.
struct StylusSample : PoseSample {
  bool button = false;
};

/// An edge of one of a stylus' buttons.
enum class Press { grasp, release, next_tool, clutch_on, clutch_off };

/// Source of a stylus: a device, a recording or a script. Stamps are passed on as they come, including repeated and
/// backward ones (PoseTrack ignores those).
class StylusSource {
 public:
  virtual ~StylusSource() = default;
  /// The next sample, or nothing when there are no more.
  virtual std::optional<StylusSample> next() = 0;
};

}  // namespace spring_workbench::motion
