#include "load_scale.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "constants.h"
#include "spring_workbench/fork_mesh/load_color.h"
#include "spring_workbench/geometry/shape_queries.h"
#include "spring_workbench/ros/common/conversions.h"
#include "spring_workbench/tools/calibration.h"

namespace spring_workbench::markers {
namespace {

const Color legend_color(0.9, 0.9, 0.9, 1.0);

/// Left back bottom corner of all bodies at their start poses, without the bench.
Vector3d legend_corner(const scene::Scene& scene) {
  Eigen::AlignedBox3d all;
  for (const scene::Body& body : scene.bodies) {
    for (const geometry::Shape& shape : body.visual)
      all.extend(geometry::bounding_box(shape.geometry, body.X_WO * shape.X_OS));
  }
  return all.isEmpty() ? Vector3d(0.0, 0.0, scene.bench_height)
                       : Vector3d(all.min().x(), all.max().y(), scene.bench_height);
}

}  // namespace

double virtual_kilograms(double force, const scene::Scene& scene) {
  return force / tools::weighing_gravity(scene.gravity);
}

Color load_color(double place) {
  Color color;
  color << fork_mesh::load_color(place), 1.0;
  return color;
}

LoadScale::LoadScale(const live::View& view)
    : range_(*view.scene, view.settings.grasp.world_goal),
      gravity_(tools::weighing_gravity(view.scene->gravity)),
      foot_(legend_corner(*view.scene) + Vector3d(0.5 * legend_edge, -0.5 * legend_edge, 0.05)) {
  if (view.settings.grasp.calibrate == tools::Calibration::world) {
    stretch_stiffness_ = view.settings.fork.stiffness.stretch;
  }
  marks_ = marks();
}

double LoadScale::height(double place) const { return (0.5 + place * (legend_steps - 1)) * legend_edge; }

std::string LoadScale::label(double weight) const {
  char text[80];
  const int end = std::snprintf(text, sizeof text, "%.3g vkg", weight / gravity_);
  if (stretch_stiffness_ > 0.0) {
    std::snprintf(text + end, sizeof text - static_cast<std::size_t>(end), "  %.3g mm",
                  1e3 * weight / stretch_stiffness_);
  }
  return text;
}

/// The heaviest, the lightest, then the others, as far as there is space for their labels.
std::vector<LoadScale::Mark> LoadScale::marks() const {
  std::vector<double> in_order = range_.weights();
  if (in_order.size() > 1) std::rotate(in_order.begin() + 1, in_order.end() - 1, in_order.end());
  std::vector<Mark> marks;
  for (const double weight : in_order) {
    const double z = height(range_.place(weight));
    const auto near = [&](const Mark& other) { return std::abs(other.height - z) < 0.9 * legend_letters; };
    if (std::none_of(marks.begin(), marks.end(), near)) marks.push_back({z, label(weight)});
  }
  return marks;
}

void LoadScale::draw_legend(MarkerList& markers) const {
  std::vector<Vector3d> centres;
  for (int i = 0; i < legend_steps; ++i) centres.push_back(foot_ + Vector3d(0.0, 0.0, (i + 0.5) * legend_edge));
  visualization_msgs::Marker& column =
      markers.add_points("legend", 0, visualization_msgs::Marker::CUBE_LIST, centres, legend_color);
  column.scale = ros_common::to_vector(Vector3d::Constant(legend_edge));
  for (int i = 0; i < legend_steps; ++i) {
    column.colors.push_back(to_color(load_color(static_cast<double>(i) / (legend_steps - 1))));
  }
  char full[80];
  std::snprintf(full, sizeof full, "%.4g N = %.3g vkg", range_.full(), range_.full() / gravity_);
  const Vector3d above(6.0 * legend_letters, 0.0, legend_steps * legend_edge + 1.6 * legend_letters);
  markers.add_text("legend", 2, foot_ + above, legend_letters, full, legend_color);
  int id = 0;
  for (const auto& [z, label] : marks_) {
    markers.add_text("legend marks", ++id, foot_ + Vector3d(6.0 * legend_letters, 0.0, z), legend_letters, label,
                     legend_color);
  }
}

void LoadScale::draw_load(const tools::ToolState& tool, const std::string& number, MarkerList& markers) const {
  const Vector3d at = foot_ + Vector3d(-0.5 * legend_edge, 0.0, height(tool.load));
  markers.add_arrow("legend load" + number, 0, at - Vector3d(4.0 * legend_edge, 0.0, 0.0), at, 0.4 * legend_edge,
                    legend_color);
}

}  // namespace spring_workbench::markers
