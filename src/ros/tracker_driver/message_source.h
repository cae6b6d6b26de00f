#pragma once

#include "spring_workbench/motion/live_source.h"

namespace spring_workbench::tracker_driver {

/// A live source that messages move: station 1 at an even rate, from the newest of them. The messages are handled while
/// it reads.
class MessageSource : public motion::LiveSource {
 public:
  std::vector<motion::StationSample> read(double timeout) override;

 protected:
  /// Pose and buttons of the stylus, `dt` [s] after the last call; where it starts on the first.
  virtual void advance(double dt, motion::StationSample& sample) = 0;

 private:
  double last_ = 0.0;  ///< when the newest sample was due [s]; 0: none yet
};

}  // namespace spring_workbench::tracker_driver
