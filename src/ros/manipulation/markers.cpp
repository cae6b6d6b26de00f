#include "spring_workbench/ros/manipulation/markers.h"

#include "fork_markers.h"
#include "load_scale.h"
#include "marker_list.h"
#include "scene_markers.h"

namespace spring_workbench::manipulation {

using visualization_msgs::Marker;
using visualization_msgs::MarkerArray;

MarkerBuilder::MarkerBuilder(std::string fork_curve, double lifetime)
    : fork_curve_(std::move(fork_curve)), lifetime_(lifetime), fork_(fork_mesh::ForkLook()) {}

MarkerArray MarkerBuilder::build(const simulation::Simulation& simulation, const std_msgs::Header& header) {
  const scene::Scene& scene = simulation.scene();
  const tools::ToolState tool = simulation.fork();
  const LoadScale scale(scene);
  deform(tool);

  MarkerList list(header, lifetime_);
  draw_bodies(simulation, list);
  draw_targets(scene, list);
  draw_shadows(simulation, fork_mesh_.vertices, list);
  draw_fork(fork_, fork_mesh_, tool, scale.color(LoadScale::load(tool)), "", list);
  if (const tools::ToolState second = simulation.fork(1); second.present) {
    deform(second);
    draw_fork(fork_, fork_mesh_, second, scale.color(LoadScale::load(second)), "_2", list);
  }
  draw_load(scene, tool, list);
  scale.draw_legend(scene, list);
  draw_contacts(simulation.contacts(), tool.length, list);
  MarkerArray markers = list.take();
  delete_what_is_gone(header, markers);
  return markers;
}

void MarkerBuilder::deform(const tools::ToolState& tool) {
  const auto shape = rod::make_shape_model(tool.shape, tool.length);
  fork_.deform(fork_mesh::make_fork_curve(fork_curve_, *shape, tool.strain, tool.X_WH_proxy),
               fork_mesh::coil_diameter(tool.length), fork_mesh_);
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

}  // namespace spring_workbench::manipulation
