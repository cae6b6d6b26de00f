#include "messages.h"

#include <limits>

#include "spring_workbench/fork_mesh/fork_model.h"
#include "spring_workbench/math/spatial.h"
#include "spring_workbench/ros/common/conversions.h"
#include "spring_workbench/validation/names.h"

namespace spring_workbench::manipulation {

ObjectState to_message(const bodies::BodyState& object) {
  ObjectState message;
  message.name = object.name;
  message.pose = ros_common::to_pose(object.X_WO);
  message.twist.linear = ros_common::to_vector(object.V_WO_W.linear);
  message.twist.angular = ros_common::to_vector(object.V_WO_W.angular);
  message.held = object.held;
  message.highlighted = object.highlighted;
  message.in_contact = object.in_contact;
  message.asleep = object.asleep;
  return message;
}

ForkState to_message(const tools::ToolState& tool, double fork_diameter) {
  ForkState message;
  message.tool = validation::name_of(tool.tool);
  message.held_object = tool.held_object;
  message.touched = tool.touched;
  message.shape = validation::name_of(tool.shape);
  message.integrator = validation::name_of(tool.integrator);
  message.stretch_on = tool.dofs.stretch;
  message.bend_on = tool.dofs.bend;
  message.torsion_on = tool.dofs.torsion;
  message.length = tool.length;
  message.diameter = fork_mesh::drawn_diameter(message.tool, tool.length, fork_diameter);
  message.stretch_stiffness = tool.stiffness.stretch;
  message.bend_stiffness = tool.stiffness.bend;
  message.torsion_stiffness = tool.stiffness.torsion;
  message.damping_law = validation::name_of(tool.damping_law);
  message.stretch_damping_ratio = tool.damping_ratio.stretch;
  message.bend_damping_ratio = tool.damping_ratio.bend;
  message.torsion_damping_ratio = tool.damping_ratio.torsion;
  message.stretch_damping_coefficient = tool.damping_coefficient.stretch;
  message.bend_damping_coefficient = tool.damping_coefficient.bend;
  message.torsion_damping_coefficient = tool.damping_coefficient.torsion;
  message.strain.assign(tool.strain.data(), tool.strain.data() + tool.strain.size());
  message.stretch = tool.stretch;
  message.bend = {tool.bend.x(), tool.bend.y()};
  message.torsion = tool.torsion;
  message.handle = ros_common::to_pose(tool.X_WH);
  message.proxy_handle = ros_common::to_pose(tool.X_WH_proxy);
  message.tip = ros_common::to_pose(tool.X_WE);
  message.tip_wrench = ros_common::to_wrench(tool.tip_wrench_W);
  message.elastic_energy = tool.elastic_energy;
  message.kinetic_energy = tool.kinetic_energy;
  message.force_scale = tool.force_scale;
  message.weight = tool.weight;
  message.torque = tool.torque;
  message.weight_mean = tool.weight_average.mean;
  message.weight_uncertainty = tool.weight_average.uncertainty;
  message.torque_mean = tool.torque_average.mean;
  message.torque_uncertainty = tool.torque_average.uncertainty;
  message.stretching_force = tool.stretching_force;
  message.bending_force = tool.bending_force;
  message.force_angle = tool.force_angle;
  message.load = tool.load;
  message.clutch = tool.clutch;
  message.material_stiffness = tool.material_stiffness;
  message.material_stiffness_uncertainty = tool.material_stiffness_uncertainty;
  return message;
}

Contacts to_message(const std::vector<contact::ContactState>& contacts) {
  Contacts message;
  for (const contact::ContactState& state : contacts) {
    Contact contact;
    contact.object = state.object;
    contact.other = state.other;
    contact.point = ros_common::to_point(state.p_W);
    contact.normal = ros_common::to_vector(state.n_W);
    contact.depth = state.depth;
    contact.impulse = state.impulse;
    contact.slip_speed = state.slip_speed;
    contact.phase = state.phase == contact::ContactPhase::started ? Contact::STARTED
                    : state.phase == contact::ContactPhase::ended ? Contact::ENDED
                                                                  : Contact::PERSISTING;
    message.contacts.push_back(contact);
  }
  return message;
}

TaskState to_message(const std::vector<assembly::Placement>& placements, const assembly::TaskScore& score) {
  TaskState message;
  for (const assembly::Placement& placement : placements) {
    PlacementState p;
    p.object = placement.object;
    p.position_error = placement.position_error;
    p.angle_error = placement.angle_error;
    p.in_place = placement.in_place;
    p.broken = placement.broken;
    message.placements.push_back(p);
  }
  message.targets = static_cast<uint32_t>(score.targets);
  message.placed = static_cast<uint32_t>(score.placed);
  message.complete = score.complete();
  message.time = score.time;
  message.hand_path = score.hand_path;
  message.object_path = score.object_path;
  message.grasps = static_cast<uint32_t>(score.grasps);
  message.collisions = static_cast<uint32_t>(score.collisions);
  message.drops = static_cast<uint32_t>(score.drops);
  message.broken = static_cast<uint32_t>(score.broken);
  message.largest_force = score.largest_force;
  message.position_error = score.position_error;
  message.angle_error = score.angle_error;
  message.csv = assembly::score_csv(score);
  return message;
}

Accepted to_message(const hand_input::AcceptedInput& accepted) {
  Accepted message;
  message.kind = static_cast<uint8_t>(accepted.kind);
  message.stylus = static_cast<uint8_t>(accepted.hand + 1);
  message.time = accepted.t;
  message.committed = accepted.committed;
  Eigen::Map<Eigen::Matrix<double, 3, 4, Eigen::RowMajor>>(message.stylus_pose.data()) = accepted.X_WS.affine();
  if (accepted.kind == hand_input::AcceptedInput::Kind::external_wrench) {
    const Vector6d wrench = to_vector(accepted.wrench.wrench);
    message.wrench.assign(wrench.data(), wrench.data() + wrench.size());
    message.wrench_axes = static_cast<uint8_t>(accepted.wrench.axes);
  }
  return message;
}

Change to_message(const live::Change& change) {
  Change message;
  message.what = change.what;
  message.command = change.command.words();
  message.scene = change.scene;
  message.hash_before = math::to_hex(change.hash_before);
  if (change.state != simulation::SimulationState()) message.state = serialise(change.state);
  return message;
}

StepReport to_message(const simulation::AdvanceReport& report) {
  StepReport message;
  message.simulated_time = report.simulated_time;
  message.steps = static_cast<uint32_t>(report.steps);
  message.position_error = report.position_error;
  message.angle_error = report.angle_error;
  constexpr double none = std::numeric_limits<double>::infinity();
  message.local_error_bound = report.local_error_bound.value_or(none);
  message.error_bound = report.error_bound.value_or(none);
  message.angle_error_bound = report.angle_error_bound.value_or(none);
  message.integrations_without_bound = static_cast<uint32_t>(report.integrations_without_bound);
  message.energy_balance = report.energy_balance;
  message.stiffest_omega_dt = report.stiffest_omega_dt;
  message.collision_queries = static_cast<uint32_t>(report.collision_queries);
  message.substeps = static_cast<uint32_t>(report.substeps);
  message.stops = static_cast<uint32_t>(report.stops);
  message.steps_fallback = static_cast<uint32_t>(report.steps_fallback);
  message.energy_error = report.energy_error;
  message.steps_blocked = static_cast<uint32_t>(report.steps_blocked);
  message.steps_unsolved = static_cast<uint32_t>(report.steps_unsolved);
  message.time_lost = report.time_lost;
  message.steps_rejected = static_cast<uint32_t>(report.steps_rejected);
  message.active = report.active();
  message.skipped = report.skipped();
  return message;
}

}  // namespace spring_workbench::manipulation
