#include "spring_workbench/ros/markers/markers.h"

#include "fork_markers.h"
#include "load_scale.h"
#include "marker_list.h"
#include "scene_markers.h"
#include "shadows.h"
#include "spring_workbench/validation/names.h"

namespace spring_workbench::markers {

using visualization_msgs::Marker;
using visualization_msgs::MarkerArray;

MarkerBuilder::MarkerBuilder(std::string fork_curve, double fork_diameter, double lifetime, Drawn drawn)
    : fork_curve_(std::move(fork_curve)), fork_diameter_(fork_diameter), lifetime_(lifetime), drawn_(drawn) {}

MarkerBuilder::~MarkerBuilder() = default;

MarkerArray MarkerBuilder::build(const live::View& view, const std_msgs::Header& header) {
  if (view.scene != scene_) {
    scene_ = view.scene;
    scale_ = std::make_unique<LoadScale>(view);
    shadows_ = std::make_unique<Shadows>();
  }
  MarkerList list(header, lifetime_);
  if (drawn_ == Drawn::everything) draw_bodies(view, list);
  draw_targets(*scene_, list);
  scale_->draw_legend(list);
  for (std::size_t hand = 0; hand < view.tools.size(); ++hand) draw_hand(view, hand, list);
  shadows_->draw(view, forks_W_, list);
  draw_contacts(view.contacts, view.tools.front().length, list);
  MarkerArray markers = list.take();
  delete_stale_markers(header, markers);
  return markers;
}

void MarkerBuilder::draw_hand(const live::View& view, std::size_t hand, MarkerList& list) {
  if (hand == 0) forks_W_.clear();
  const tools::ToolState& tool = view.tools[hand];
  if (hand > 0 && !tool.present) return;
  const std::string number = hand > 0 ? "_" + std::to_string(hand + 1) : "";
  const fork_mesh::ForkModel& model = deform(tool);
  forks_W_.push_back(fork_mesh_.vertices);
  if (drawn_ == Drawn::everything) draw_fork(model, fork_mesh_, load_color(tool.load), number, list);
  draw_gap(tool, number, list);
  draw_load(*view.scene, tool, number, list);
  if (!tool.held_object.empty()) scale_->draw_load(tool, number, list);
}

const fork_mesh::ForkModel& MarkerBuilder::deform(const tools::ToolState& tool) {
  const std::string name = validation::name_of(tool.tool);
  const auto model = models_.try_emplace(tool.tool, fork_mesh::appearance_of(name)).first;
  const auto shape = rod::make_shape_model(tool.shape, tool.length);
  model->second.deform(fork_mesh::make_fork_curve(fork_curve_, *shape, tool.strain, tool.X_WH_proxy),
                       fork_mesh::drawn_diameter(name, tool.length, fork_diameter_), fork_mesh_);
  return model->second;
}

void MarkerBuilder::delete_stale_markers(const std_msgs::Header& header, MarkerArray& markers) {
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

}  // namespace spring_workbench::markers
