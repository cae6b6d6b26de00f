#pragma once

#include <ros/node_handle.h>

#include <memory>
#include <string>

#include "spring_workbench/motion/live_source.h"
#include "spring_workbench/ros/tracker_driver/joy_motion.h"

namespace spring_workbench::tracker_driver {

/// A live source that messages move: station 1 at an even rate, from the newest of them. The messages are handled while
/// it reads.
class MessageSource : public motion::LiveSource {
 public:
  std::vector<motion::StationSample> read(double timeout) override;

 protected:
  /// The stylus in the workbench, `dt` [s] after the last call; where it starts on the first. Sets the sample's
  /// buttons.
  virtual const RigidTransform& advance(double dt, motion::StationSample& sample) = 0;

 private:
  double last_ = 0.0;  ///< when the newest sample was due [s]; 0: none yet
};

/// A stylus moved by the messages of a game pad or a 3D mouse on the topic `joy`. `X_WB`: the stylus at the start, in
/// the workbench.
std::unique_ptr<motion::LiveSource> make_joy_source(const ros::NodeHandle& node, const JoySettings& settings,
                                                    const RigidTransform& X_WB);

/// A stylus dragged with the mouse in rviz: an interactive marker with six degrees of freedom under `stylus/marker`,
/// with grasping and the next tool in its menu, grasping also by the service `~grasp`. `X_WB`: the stylus at the start,
/// in the frame `workbench_frame`.
std::unique_ptr<motion::LiveSource> make_interactive_marker_source(const ros::NodeHandle& private_node,
                                                                   const std::string& workbench_frame,
                                                                   const RigidTransform& X_WB);

}  // namespace spring_workbench::tracker_driver
