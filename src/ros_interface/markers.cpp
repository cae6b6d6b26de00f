#include "spring_workbench/ros_interface/markers.h"

#include "fork_markers.h"
#include "load_scale.h"
#include "marker_list.h"
#include "scene_markers.h"

namespace spring_workbench {

using visualization_msgs::Marker;
using visualization_msgs::MarkerArray;

MarkerBuilder::MarkerBuilder(std::string fork_curve, double lifetime)
    : fork_curve_(std::move(fork_curve)), lifetime_(lifetime), fork_(ForkLook()) {}

MarkerArray MarkerBuilder::build(const Simulation& simulation, const std_msgs::Header& header) {
  const Scene& scene = simulation.scene();
  const ToolState tool = simulation.fork();
  auto shape = make_shape_model(tool.shape, tool.length);
  if (auto stiff = shape->for_stiffness(tool.stiffness)) shape = std::move(stiff);
  fork_.deform(make_fork_curve(fork_curve_, *shape, tool.strain, tool.X_WH_seen), coil_diameter(tool.length),
               fork_mesh_);
  const LoadScale scale(scene);

  MarkerList list(header, lifetime_);
  draw_bodies(simulation, list);
  draw_targets(scene, list);
  draw_shadows(simulation, fork_mesh_.vertices, list);
  draw_fork(fork_, fork_mesh_, tool, scale.color(LoadScale::load(tool)), list);
  draw_load(scene, tool, list);
  scale.draw_legend(scene, list);
  draw_contacts(simulation.contacts(), tool.length, list);
  MarkerArray markers = list.take();
  delete_what_is_gone(header, markers);
  return markers;
}

void MarkerBuilder::delete_what_is_gone(const std_msgs::Header& header, MarkerArray& markers) {
  std::set<MarkerKey> now;
  for (const Marker& marker : markers.markers) now.emplace(marker.ns, marker.id);
  for (const MarkerKey& key : shown_) {
    if (now.count(key) != 0) continue;
    Marker marker;
    marker.header = header;
    marker.ns = key.first;
    marker.id = key.second;
    marker.action = Marker::DELETE;
    markers.markers.push_back(marker);
  }
  shown_ = std::move(now);
}

}  // namespace spring_workbench
