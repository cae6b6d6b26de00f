#pragma once

#include <ros/node_handle.h>

#include <memory>
#include <string>

#include "spring_workbench/motion/live_source.h"
#include "spring_workbench/ros/tracker_driver/joy_motion.h"

namespace spring_workbench::tracker_driver {

/// A live source that is moved by messages: station 1 at a constant rate, from the newest message. Messages are handled
/// during read().
class MessageSource : public motion::LiveSource {
 public:
  std::vector<motion::StationSample> read(double timeout) override;

 protected:
  /// Returns the pose of the stylus in the workbench `dt` [s] after the last call; its start pose on the first call.
  /// Sets the buttons of `sample`.
  virtual const RigidTransform& advance(double dt, motion::StationSample& sample) = 0;

 private:
  double last_ = 0.0;  ///< due time of the newest sample [s]; 0: none yet
};

/// A stylus moved by messages of a game pad or a 3D mouse on the topic `joy`. `X_WB`: start pose of the stylus in the
/// workbench.
std::unique_ptr<motion::LiveSource> make_joy_source(const ros::NodeHandle& node, const JoySettings& settings,
                                                    const RigidTransform& X_WB);

/// A stylus dragged with the mouse in rviz: an interactive marker with six degrees of freedom under `stylus/marker`,
/// with a menu for grasping and the next tool; grasping also by the service `~grasp`. `X_WB`: start pose of the stylus
/// in the frame `workbench_frame`.
std::unique_ptr<motion::LiveSource> make_interactive_marker_source(const ros::NodeHandle& private_node,
                                                                   const std::string& workbench_frame,
                                                                   const RigidTransform& X_WB);

}  // namespace spring_workbench::tracker_driver
