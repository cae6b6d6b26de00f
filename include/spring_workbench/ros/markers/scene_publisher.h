#pragma once

#include <ros/node_handle.h>

#include <memory>
#include <string>

#include "spring_workbench/SceneDescription.h"
#include "spring_workbench/scene/scene.h"

namespace spring_workbench::markers {

/// The scene as a message without header: its bodies at their start poses, each mesh once.
SceneDescription describe(const scene::Scene& scene);

/// Keeps the latched topic `~scene_description` up to date.
class ScenePublisher {
 public:
  ScenePublisher(ros::NodeHandle private_node, std::string world_frame);

  /// Publishes the scene if it differs from the last one published.
  void keep(const std::shared_ptr<const scene::Scene>& scene);

 private:
  std::string world_frame_;
  std::shared_ptr<const scene::Scene> last_checked_, sent_;
  ros::Publisher publisher_;
};

}  // namespace spring_workbench::markers
