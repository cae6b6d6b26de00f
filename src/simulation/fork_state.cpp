// What the fork tells of itself.
#include "fork_body.h"

namespace spring_workbench {

void ForkBody::describe(bool massless, ToolState& f) const {
  const StrainState full = held_.full_state(state_.t, state_.strain);
  const ShapeModel& shape = held_.shape();
  f.strain = full.q;
  f.X_WH_seen = handle().X_WH;
  f.stretch = shape.extension(full.q);
  f.torsion = shape.twist(full.q);
  const RigidTransform X_HE_bent = shape.section(full.q, shape.length());
  f.bend = X_HE_bent.translation().head<2>();
  f.X_WE = f.X_WH_seen * X_HE_bent;
  const MotionState o = object_with_acceleration();
  f.elastic_energy = held_.elastic_energy(state_.t, state_.strain);
  if (massless) return;
  f.kinetic_energy = held_.kinetic_energy(o.velocity, o.X.linear());
  // What the rod does to the object: its change of momentum less gravity and contact.
  const Matrix3d I_W = o.X.linear() * held_.body().inertia_O * o.X.linear().transpose();
  const Wrench& contact = held_.external_wrench();
  const Vector3d force =
      held_.body().mass * (o.acceleration.linear + held_.gravity() * Vector3d::UnitZ()) - contact.force;
  const Vector3d moment =
      I_W * o.acceleration.angular + o.velocity.angular.cross(I_W * o.velocity.angular) - contact.moment;
  f.tip_wrench_W.force = force;
  f.tip_wrench_W.moment = moment + (o.X.translation() - f.X_WE.translation()).cross(force);
  const Vector3d at_handle = moment + (o.X.translation() - f.X_WH_seen.translation()).cross(force);
  const Matrix3d R_HW = f.X_WH_seen.linear().transpose();
  f.handle_wrench_H.force = -(R_HW * force);
  f.handle_wrench_H.moment = -(R_HW * at_handle);
}

}  // namespace spring_workbench
