#include "spring_workbench/instruments/load_range.h"

#include <algorithm>
#include <cmath>

#include "constants.h"
#include "spring_workbench/tools/calibration.h"

namespace spring_workbench::instruments {

LoadRange::LoadRange(const scene::Scene& scene, const tools::WorldGoal& goal)
    : force_scale_(scene.force_scale),
      gravity_(tools::weighing_gravity(scene.gravity)),
      full_(tools::world_load(scene, goal).mass * gravity_) {
  for (const scene::Body& body : scene.bodies) {
    const double mass = body.mass_properties.mass;
    if (mass > 0.0) weights_.push_back(mass * gravity_);
  }
  std::sort(weights_.rbegin(), weights_.rend());
  if (!weights_.empty() && full_ > one_decade * weights_.back()) none_ = below_lightest * weights_.back();
}

void LoadRange::read(tools::ToolState& tool) const {
  const Vector3d on_tool_H = -(tool.X_WH_proxy.linear().transpose() * tool.tip_wrench_W.force);
  tool.force_scale = force_scale_;
  tool.weight = tool.tip_wrench_W.force.z() / gravity_;
  tool.torque = tool.tip_wrench_W.moment.dot(tool.X_WE.linear().col(2));
  tool.stretching_force = on_tool_H.z() + 0.0;  // −0, without a force, would be at an angle of π
  tool.bending_force = on_tool_H.head<2>().norm();
  tool.force_angle = std::atan2(tool.bending_force, tool.stretching_force);
  tool.load = place(load(tool));
}

double LoadRange::load(const tools::ToolState& tool) {
  return std::max(tool.tip_wrench_W.force.norm(), tool.tip_wrench_W.moment.norm() / tool.length);
}

double LoadRange::place(double load) const {
  if (none_ > 0.0) return load > none_ ? std::min(std::log(load / none_) / std::log(full_ / none_), 1.0) : 0.0;
  return std::clamp(load / full_, 0.0, 1.0);
}

tools::ToolState unloaded(tools::Tool tool, const rod::ForkSettings& fork, dynamics::IntegratorKind integrator,
                          double length, const RigidTransform& X_WS) {
  tools::ToolState f;
  f.tool = tool;
  f.shape = fork.shape;
  f.integrator = integrator;
  f.dofs = fork.dofs;
  f.length = length;
  f.strain = rod::StrainVector::Zero(rod::make_shape_model(f.shape, f.length)->size());
  f.stiffness = fork.stiffness;
  f.damping_ratio = fork.damping_ratio;
  f.damping_coefficient = fork.damping_coefficient;
  f.damping_law = fork.damping_law;
  f.X_WS = f.X_WH = f.X_WH_proxy = X_WS;
  f.X_WE = X_WS * Eigen::Translation3d(0.0, 0.0, f.length);
  return f;
}

}  // namespace spring_workbench::instruments
