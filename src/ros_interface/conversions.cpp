#include "spring_workbench/ros_interface/conversions.h"

namespace spring_workbench {

geometry_msgs::Point to_point(const Vector3d& p) {
  geometry_msgs::Point message;
  message.x = p.x();
  message.y = p.y();
  message.z = p.z();
  return message;
}

geometry_msgs::Vector3 to_vector(const Vector3d& v) {
  geometry_msgs::Vector3 message;
  message.x = v.x();
  message.y = v.y();
  message.z = v.z();
  return message;
}

geometry_msgs::Quaternion to_quaternion(const Matrix3d& R) {
  const Quaterniond q(R);
  geometry_msgs::Quaternion message;
  message.x = q.x();
  message.y = q.y();
  message.z = q.z();
  message.w = q.w();
  return message;
}

geometry_msgs::Pose to_pose(const RigidTransform& X) {
  geometry_msgs::Pose message;
  message.position = to_point(X.translation());
  message.orientation = to_quaternion(X.linear());
  return message;
}

geometry_msgs::Wrench to_wrench(const Wrench& wrench) {
  geometry_msgs::Wrench message;
  message.force = to_vector(wrench.force);
  message.torque = to_vector(wrench.moment);
  return message;
}

geometry_msgs::TransformStamped to_transform(const RigidTransform& X, const std::string& parent,
                                             const std::string& child, const ros::Time& stamp) {
  geometry_msgs::TransformStamped message;
  message.header.frame_id = parent;
  message.header.stamp = stamp;
  message.child_frame_id = child;
  message.transform.translation = to_vector(X.translation());
  message.transform.rotation = to_quaternion(X.linear());
  return message;
}

ObjectStates to_message(const std::vector<BodyState>& objects) {
  ObjectStates message;
  for (const BodyState& object : objects) {
    ObjectState state;
    state.name = object.name;
    state.pose = to_pose(object.X_WO);
    state.twist.linear = to_vector(object.V_WO_W.linear);
    state.twist.angular = to_vector(object.V_WO_W.angular);
    state.held = object.held;
    state.highlighted = object.highlighted;
    state.in_contact = object.in_contact;
    state.asleep = object.asleep;
    message.objects.push_back(state);
  }
  return message;
}

ForkState to_message(const ToolState& tool) {
  ForkState message;
  message.tool = tool.tool;
  message.held_object = tool.held_object;
  message.touched = tool.touched;
  message.shape = tool.shape;
  message.integrator = tool.integrator;
  message.stretch_on = tool.dofs.stretch;
  message.bend_on = tool.dofs.bend;
  message.torsion_on = tool.dofs.torsion;
  message.length = tool.length;
  message.stretch_stiffness = tool.stiffness.stretch;
  message.bend_stiffness = tool.stiffness.bend;
  message.torsion_stiffness = tool.stiffness.torsion;
  message.stretch_damping_ratio = tool.damping_ratio.stretch;
  message.bend_damping_ratio = tool.damping_ratio.bend;
  message.torsion_damping_ratio = tool.damping_ratio.torsion;
  message.strain.assign(tool.strain.data(), tool.strain.data() + tool.strain.size());
  message.stretch = tool.stretch;
  message.bend = {tool.bend.x(), tool.bend.y()};
  message.torsion = tool.torsion;
  message.handle = to_pose(tool.X_WH);
  message.handle_seen = to_pose(tool.X_WH_seen);
  message.tip = to_pose(tool.X_WE);
  message.tip_wrench = to_wrench(tool.tip_wrench_W);
  message.elastic_energy = tool.elastic_energy;
  message.kinetic_energy = tool.kinetic_energy;
  message.force_scale = tool.force_scale;
  message.weight = tool.weight;
  message.torque = tool.torque;
  message.material_stiffness = tool.material_stiffness;
  message.material_stiffness_uncertainty = tool.material_stiffness_uncertainty;
  return message;
}

Contacts to_message(const std::vector<ContactState>& contacts) {
  Contacts message;
  for (const ContactState& state : contacts) {
    Contact contact;
    contact.object = state.object;
    contact.other = state.other;
    contact.point = to_point(state.p_W);
    contact.normal = to_vector(state.n_W);
    contact.depth = state.depth;
    contact.impulse = state.impulse;
    contact.slip_speed = state.slip_speed;
    contact.phase = state.phase == ContactPhase::started ? Contact::STARTED
                    : state.phase == ContactPhase::ended ? Contact::ENDED
                                                         : Contact::PERSISTING;
    message.contacts.push_back(contact);
  }
  return message;
}

TaskState to_message(const std::vector<Placement>& placements, const TaskScore& score) {
  TaskState message;
  for (const Placement& placement : placements) {
    PlacementState p;
    p.object = placement.object;
    p.position_error = placement.position_error;
    p.angle_error = placement.angle_error;
    p.in_place = placement.in_place;
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
  message.largest_force = score.largest_force;
  message.position_error = score.position_error;
  message.angle_error = score.angle_error;
  message.csv = score_csv(score);
  return message;
}

StepReport to_message(const AdvanceReport& report) {
  StepReport message;
  message.simulated_time = report.simulated_time;
  message.steps = static_cast<uint32_t>(report.steps);
  message.position_error = report.position_error;
  message.angle_error = report.angle_error;
  message.energy_added = report.energy_added;
  message.omega_dt = report.stiffest_omega_dt;
  message.collision_queries = static_cast<uint32_t>(report.collision_queries);
  message.steps_rejected = static_cast<uint32_t>(report.steps_rejected);
  message.energy_held = static_cast<uint32_t>(report.energy_held);
  message.held_back = static_cast<uint32_t>(report.held_back);
  message.guards_tripped = static_cast<uint32_t>(report.guards_tripped);
  message.parts_run = report.parts_run;
  message.parts_left_out = report.parts_left_out;
  return message;
}

}  // namespace spring_workbench
