#include "load_scale.h"

#include <algorithm>
#include <cstdio>

#include "constants.h"
#include "spring_workbench/geometry/shape_queries.h"
#include "spring_workbench/ros/common/conversions.h"
#include "spring_workbench/tools/calibration.h"

namespace spring_workbench::manipulation {
namespace {

const Color text_color(0.9, 0.9, 0.9, 1.0);

double gravity_for_weights(const scene::Scene& scene) { return tools::weighing_gravity(scene.gravity); }

/// Left, back and bottom of all bodies where they start, but the bench.
Vector3d legend_corner(const scene::Scene& scene) {
  Eigen::AlignedBox3d all;
  for (const scene::Body& body : scene.bodies) {
    for (const geometry::Shape& shape : body.visual)
      all.extend(geometry::bounding_box(shape.geometry, body.X_WO * shape.X_OS));
  }
  return all.isEmpty() ? Vector3d(0.0, 0.0, scene.bench_height)
                       : Vector3d(all.min().x(), all.max().y(), scene.bench_height);
}

std::string label(double load, const scene::Scene& scene) {
  char text[80];
  std::snprintf(text, sizeof text, "%.3g N = %.3g vkg", load, virtual_kilograms(load, scene));
  return text;
}

}  // namespace

double virtual_kilograms(double force, const scene::Scene& scene) { return force / gravity_for_weights(scene); }

LoadScale::LoadScale(const scene::Scene& scene) {
  double heaviest = 0.0;
  for (const scene::Body& body : scene.bodies) heaviest = std::max(heaviest, body.mass_properties.mass);
  full_ = (heaviest > 0.0 ? heaviest : 1.0) * gravity_for_weights(scene);
}

double LoadScale::load(const tools::ToolState& tool) {
  return std::max(tool.tip_wrench_W.force.norm(), tool.tip_wrench_W.moment.norm() / tool.length);
}

Color LoadScale::color(double load) const {
  static const Color stops[] = {{0.52, 0.66, 0.84, 1.0}, {1.0, 0.85, 0.2, 1.0}, {0.88, 0.08, 0.05, 1.0}};
  const double place = 2.0 * std::clamp(load / full_, 0.0, 1.0);
  const int below = place < 1.0 ? 0 : 1;
  return stops[below] + (place - below) * (stops[below + 1] - stops[below]);
}

void LoadScale::draw_legend(const scene::Scene& scene, MarkerList& markers) const {
  const Vector3d foot = legend_corner(scene) + Vector3d(0.5 * legend_edge, -0.5 * legend_edge, 0.05);
  std::vector<Vector3d> centres;
  for (int i = 0; i < legend_steps; ++i) centres.push_back(foot + Vector3d(0.0, 0.0, (i + 0.5) * legend_edge));
  visualization_msgs::Marker& column =
      markers.add_points("legend", 0, visualization_msgs::Marker::CUBE_LIST, centres, text_color);
  column.scale = ros_common::to_vector(Vector3d::Constant(legend_edge));
  for (int i = 0; i < legend_steps; ++i) column.colors.push_back(to_color(color(full_ * i / (legend_steps - 1))));
  markers.add_text("legend", 1, foot - Vector3d(0.0, 0.0, 0.6 * legend_letters), legend_letters, "0", text_color);
  markers.add_text("legend", 2, foot + Vector3d(0.0, 0.0, legend_steps * legend_edge + 0.6 * legend_letters),
                   legend_letters, label(full_, scene), text_color);
}

}  // namespace spring_workbench::manipulation
