#include "spring_workbench/assembly/operator_job.h"

#include <utility>

#include "constants.h"
#include "spring_workbench/assembly/placement.h"
#include "spring_workbench/math/so3.h"

namespace spring_workbench::assembly {

OperatorJob::OperatorJob(scene::Body body, scene::Target target) : body_(std::move(body)), target_(std::move(target)) {}

std::vector<Vector3d> OperatorJob::grips() const {
  std::vector<Vector3d> points;
  for (const Vector3d& p_LG : target_.p_LG) points.push_back(body_.X_OL * p_LG);
  return points.empty() ? std::vector<Vector3d>{Vector3d::Zero()} : points;
}

bool OperatorJob::can_be_turned(bool turns) const { return angle_matters(target_) && turns; }

bool OperatorJob::done(const bodies::BodyState& object, bool turns) const {
  const Placement placement = judge_placement(body_, target_, object.X_WO, object.held);
  const bool near = placement.position_error <= target_.position_tolerance;
  return placement.in_place || (!can_be_turned(turns) && near && !object.held);
}

RigidTransform OperatorJob::goal(const bodies::BodyState& object, bool turns, double lift) const {
  RigidTransform X_WO = target_.X_WL * body_.X_OL.inverse();
  if (!can_be_turned(turns)) X_WO.linear() = object.X_WO.linear();
  X_WO.translation().z() += lift;
  return X_WO;
}

bool OperatorJob::off(const bodies::BodyState& object, const RigidTransform& X_WO_goal, bool height_too) const {
  const Vector3d d = X_WO_goal.translation() - object.X_WO.translation();
  const double angle = math::log_so3(X_WO_goal.linear().transpose() * object.X_WO.linear()).norm();
  return d.head<2>().norm() > good_enough * target_.position_tolerance ||
         angle > good_enough * target_.angle_tolerance || (height_too && d.z() < -touching);
}

}  // namespace spring_workbench::assembly
