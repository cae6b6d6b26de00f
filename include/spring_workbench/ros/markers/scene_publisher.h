#pragma once

#include <ros/node_handle.h>

#include <memory>
#include <string>

#include "spring_workbench/SceneDescription.h"
#include "spring_workbench/scene/scene.h"

namespace spring_workbench::markers {

/// The scene as a message, without its header: its bodies where they start, each mesh once.
SceneDescription describe(const scene::Scene& scene);

/// Keeps the latched topic `~scene_description` as the scene is.
class ScenePublisher {
 public:
  ScenePublisher(ros::NodeHandle private_node, std::string world_frame);

  /// Sends it if it is another than the one that was sent last.
  void keep(const std::shared_ptr<const scene::Scene>& scene);

 private:
  std::string world_frame_;
  std::shared_ptr<const scene::Scene> seen_, sent_;
  ros::Publisher publisher_;
};

}  // namespace spring_workbench::markers
