#pragma once

#include <ros/node_handle.h>

#include <string>
#include <vector>

#include "spring_workbench/SceneDescription.h"
#include "spring_workbench/scene/scene.h"

namespace spring_workbench::markers {

/// The scene as a message, without its header: its bodies where they start, each mesh once.
SceneDescription describe(const scene::Scene& scene);

/// Keeps the latched topic `~scene_description` as the scene is.
class ScenePublisher {
 public:
  ScenePublisher(ros::NodeHandle private_node, std::string world_frame);

  /// Whether the scene is another than the one that was sent last.
  bool is_new(const scene::Scene& scene) const;
  void publish(const scene::Scene& scene);

 private:
  std::string world_frame_;
  scene::Scene sent_;  ///< meshes are shared, not copied
  ros::Publisher publisher_;
};

}  // namespace spring_workbench::markers
