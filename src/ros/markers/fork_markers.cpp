#include "fork_markers.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "constants.h"
#include "spring_workbench/ros/common/conversions.h"
#include "spring_workbench/validation/names.h"

namespace spring_workbench::markers {
namespace {

using visualization_msgs::Marker;

const Color rigid_color(0.55, 0.58, 0.63, 1.0);
const Color force_color(0.10, 0.85, 0.95, 1.0);
const Color moment_color(0.75, 0.45, 1.0, 1.0);
const Color gap_color(1.0, 0.3, 0.8, 1.0);
const Color readout_color(1.0, 1.0, 1.0, 1.0);

void add_triangles(const std::string& ns, int id, const fork_mesh::ForkModel::Triangles& triangles,
                   const fork_mesh::ForkMesh& mesh, const Color& color, MarkerList& markers) {
  if (triangles.empty()) return;
  Marker& marker = markers.add(ns, id, Marker::TRIANGLE_LIST, RigidTransform::Identity(), color);
  marker.points.reserve(3 * triangles.size());
  for (const Eigen::Vector3i& t : triangles) {
    for (const int corner : t)
      marker.points.push_back(ros_common::to_point(mesh.vertices[static_cast<std::size_t>(corner)]));
  }
}

/// Draws an arrow at the tip, unless it is too short to be visible.
void draw_arrow(const std::string& ns, const tools::ToolState& tool, const Vector3d& arrow, const Color& color,
                MarkerList& markers) {
  const double length = arrow.norm();
  if (!(length > shortest_arrow)) return;
  const Vector3d begin = tool.X_WE.translation();
  markers.add_arrow(ns, 0, begin, begin + arrow * std::min(1.0, longest_arrow / length), 0.03 * tool.length, color);
}

std::string printed(const char* format, double a, double b, double c = 0.0) {
  char text[100];
  std::snprintf(text, sizeof text, format, a, b, c);
  return text;
}

/// Rounds to a multiple of 1/`parts`; never to -0.
double rounded(double x, double parts) { return std::round(parts * x) / parts + 0.0; }

std::string printed(const tools::Reading& average, double scale, const char* unit) {
  if (!std::isfinite(average.uncertainty)) return "";
  return printed("\nmean %.3f +/- %.3f ", rounded(average.mean / scale, 1e3), average.uncertainty / scale) + unit;
}

/// The further lines of the text: the readings of the tool. rviz can only draw ASCII.
std::string reading(const tools::ToolState& tool, double force_scale) {
  if (!tool.touched.empty()) {
    if (tool.material_stiffness <= 0.0) return "";
    if (std::isinf(tool.material_stiffness)) return "\nmaterial: rigid";
    return printed("\nmaterial: %.3g +/- %.1g N/m", tool.material_stiffness, tool.material_stiffness_uncertainty);
  }
  const std::string weight = printed(tool.weight_average, 1.0, "vkg");
  const std::string torque = printed(tool.torque_average, force_scale, "N m");
  constexpr double degree = M_PI / 180.0;
  return weight + torque +
         printed("\n%.1f N along   %.1f N across   %.0f deg", rounded(tool.stretching_force / force_scale, 10.0),
                 tool.bending_force / force_scale, tool.force_angle / degree);
}

void draw_readout(const scene::Scene& scene, const tools::ToolState& tool, const std::string& number,
                  MarkerList& markers) {
  const double force = tool.tip_wrench_W.force.norm();
  const double size =
      fork_mesh::drawn_diameter(validation::name_of(tool.tool), tool.length) / fork_mesh::default_diameter;
  const std::string load = printed("%.2f vkg   %.2f N   %.3f N m", virtual_kilograms(force, scene),
                                   force / scene.force_scale, tool.tip_wrench_W.moment.norm() / scene.force_scale);
  const Vector3d place = tool.X_WH_proxy * Vector3d(0.0, 0.0, -0.5 * size) + 0.4 * size * Vector3d::UnitZ();
  markers.add_text("readout" + number, 0, place, 0.09 * size, load + reading(tool, scene.force_scale), readout_color);
}

}  // namespace

void draw_fork(const fork_mesh::ForkModel& model, const fork_mesh::ForkMesh& mesh, const Color& spring_color,
               const std::string& number, MarkerList& markers) {
  add_triangles("fork" + number, 0, model.spring(), mesh, spring_color, markers);
  add_triangles("fork" + number, 1, model.shaft_and_end(), mesh, rigid_color, markers);
}

void draw_gap(const tools::ToolState& tool, const std::string& number, MarkerList& markers) {
  const Vector3d hand = tool.X_WH.translation(), seen = tool.X_WH_proxy.translation();
  if ((hand - seen).norm() < smallest_gap) return;
  markers.add_points("gap" + number, 0, Marker::LINE_LIST, {hand, seen}, gap_color).scale.x = 0.01 * tool.length;
}

void draw_load(const scene::Scene& scene, const tools::ToolState& tool, const std::string& number,
               MarkerList& markers) {
  if (!tool.touched.empty()) draw_readout(scene, tool, number, markers);
  const auto held = scene::find_body(scene, tool.held_object);
  if (!held) return;
  const double weight = scene.bodies[*held].mass_properties.mass * std::max(scene.gravity, 1.0);
  if (weight > 0.0) {
    draw_arrow("force" + number, tool, 0.5 * tool.length / weight * tool.tip_wrench_W.force, force_color, markers);
    draw_arrow("moment" + number, tool, 2.5 / weight * tool.tip_wrench_W.moment, moment_color, markers);
  }
  draw_readout(scene, tool, number, markers);
}

}  // namespace spring_workbench::markers
