#include "spring_workbench/tools/hold_maker.h"

#include <algorithm>
#include <utility>

#include "constants.h"
#include "fork_body.h"
#include "spring_body.h"
#include "spring_workbench/bodies/pulled_body.h"
#include "spring_workbench/rod/shape_model.h"

namespace spring_workbench::tools {
rod::ForkDofs HoldMaker::possible_dofs(const Grasp& grasp, const GraspedBody& object) const {
  if (object.massless() || grasp.tool != Tool::spring_fork) return {false, false, false};
  rod::ForkDofs dofs = fork_.dofs;
  const Vector3d lever = grasp.X_OE.linear().col(2).cross(grasp.X_OE.translation());
  const bool point_mass = dynamics_.inertia == dynamics::Inertia::point_mass;
  if (point_mass && lever.norm() < on_the_axis * fork_.length) dofs.torsion = false;
  return dofs;
}

dynamics::BodyInertia HoldMaker::inertia(const Grasp& grasp, const GraspedBody& object) const {
  const scene::MassProperties& of_body = object.body.mass_properties;
  if (object.massless()) {
    return {1.0, Matrix3d::Identity(), grasp.X_OE};  // no effect: a fork that carries nothing does not bend
  }
  dynamics::BodyInertia inertia{of_body.mass, of_body.inertia_O, grasp.X_OE};
  if (dynamics_.inertia == dynamics::Inertia::point_mass) {
    // The paper's I = r² m: all of the mass at its centre. A small radius keeps the rotation about that point defined.
    const double radius = point_mass_radius * fork_.length;
    inertia.inertia_O = inertia.mass * radius * radius * Matrix3d::Identity();
  }
  return inertia;
}

std::unique_ptr<ToolHold> HoldMaker::make_fork(const Grasp& grasp, const GraspedBody& object,
                                               stepping::StepControl control, double now) const {
  // Rigid tools are as short as possible, so that the motion of their object does not depend on a length.
  const auto shape = grasp.tool == Tool::spring_fork
                         ? rod::make_shape_model(fork_.shape, grasp.length, fork_.slope_stiffness)
                         : rod::make_shape_model(rod::ShapeKind::bushing, grasp.length);
  dynamics::HeldBody held(shape, inertia(grasp, object), gravity_);
  held.set_springs(fork_);
  const dynamics::StrainState zero{rod::StrainVector::Zero(held.shape().size()),
                                   rod::StrainVector::Zero(held.shape().size())};
  held.set_dofs(possible_dofs(grasp, object), now, fork_.switch_off_time, zero);
  RigidTransform X_SH = RigidTransform::Identity();
  X_SH.translation().z() = grasp.reach - grasp.length;
  return std::make_unique<ForkBody>(object.index, std::move(held), std::move(control), now, X_SH);
}

std::unique_ptr<ToolHold> HoldMaker::make(const Grasp& grasp, const GraspedBody& object, double now,
                                          ToolHold* before) const {
  stepping::StepControl control = stepping::make_step_control(dynamics_);
  if (before != nullptr) control.swap_integrator(before->step_control());
  if (grasp.tool != Tool::spring || object.massless()) return make_fork(grasp, object, std::move(control), now);
  const double rest_length = std::max((object.X_WO.translation() - grasp.X_WS.translation()).norm(), min_rest_length);
  return std::make_unique<SpringBody>(object.index, object.body, gravity_, object.X_WO, std::move(control), now,
                                      rest_length, fork_);
}

std::unique_ptr<ToolHold> HoldMaker::make_pushable(const GraspedBody& object, const Twist& V_WO_W, double now) const {
  auto body = std::make_unique<ForkBody>(object.index, unheld(object.body, gravity_),
                                         stepping::make_step_control(dynamics_), now, RigidTransform::Identity());
  body->set_hand(frame_at_rest(object.X_WO), now);
  body->take_twist(V_WO_W);
  return body;
}

std::unique_ptr<bodies::SteppedBody> HoldMaker::make_pulled(const Grasp& grasp, const GraspedBody& object,
                                                            const Twist& V_WO_W, const Wrench& load_W) const {
  scene::Body body;
  const dynamics::BodyInertia of_object = inertia(grasp, object);
  body.mass_properties = {of_object.mass, of_object.inertia_O};
  return std::make_unique<bodies::PulledBody>(bodies::FreeBody(object.index, body, gravity_, object.X_WO, V_WO_W),
                                              load_W);
}

}  // namespace spring_workbench::tools
