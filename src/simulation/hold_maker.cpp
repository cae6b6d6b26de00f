#include "hold_maker.h"

#include <algorithm>
#include <utility>

#include "fork_body.h"
#include "spring_body.h"
#include "spring_workbench/rod/shape_model.h"

namespace spring_workbench {
namespace {

constexpr double least_rest_length = 1e-4;  ///< [m] of the tool `spring`
constexpr double point_mass_radius = 1e-2;  ///< of the fork's length: radius of gyration of a point mass
constexpr double on_the_axis = 1e-3;  ///< of the fork's length; a point mass so near to the fork's axis cannot twist it

}  // namespace

ForkDofs HoldMaker::possible_dofs(const Grasp& grasp) const {
  if (workbench_.massless(grasp.object) || grasp.tool != Tool::spring_fork) return {false, false, false};
  ForkDofs dofs = settings_.fork.dofs;
  const Vector3d lever = grasp.X_OE.linear().col(2).cross(grasp.X_OE.translation());
  const bool point_mass = settings_.dynamics.inertia == "point_mass";
  if (point_mass && lever.norm() < on_the_axis * settings_.fork.length) dofs.torsion = false;
  return dofs;
}

BodyInertia HoldMaker::inertia(const Grasp& grasp) const {
  const MassProperties& of_body = workbench_.body(grasp.object).mass_properties;
  if (workbench_.massless(grasp.object)) {
    return {1.0, Matrix3d::Identity(), grasp.X_OE};  // of no effect: nothing bends a fork that carries nothing
  }
  BodyInertia inertia{of_body.mass, of_body.inertia_O, grasp.X_OE};
  if (settings_.dynamics.inertia == "point_mass") {
    // The paper's I = r² m: all of the mass at its centre. A small radius keeps the rotation about that point defined.
    const double radius = point_mass_radius * settings_.fork.length;
    inertia.inertia_O = inertia.mass * radius * radius * Matrix3d::Identity();
  }
  return inertia;
}

std::unique_ptr<ToolHold> HoldMaker::make_fork(const Grasp& grasp, double now) const {
  // A rigid tool may be as short as can be: what its object still moves must not depend on a length.
  const std::string shape = grasp.tool == Tool::spring_fork ? settings_.fork.shape : "bushing";
  HeldBody held(make_shape_model(shape, grasp.length), inertia(grasp), scene_.gravity);
  held.set_springs(settings_.fork);
  const StrainState zero{StrainVector::Zero(held.shape().size()), StrainVector::Zero(held.shape().size())};
  held.set_dofs(possible_dofs(grasp), now, settings_.fork.switch_off_time, zero);
  RigidTransform X_SH = RigidTransform::Identity();
  X_SH.translation().z() = grasp.reach - grasp.length;
  return std::make_unique<ForkBody>(workbench_.scene_index(grasp.object), std::move(held),
                                    ForkBody::make_step_control(settings_.dynamics), now, X_SH);
}

std::unique_ptr<ToolHold> HoldMaker::make(const Grasp& grasp, double now) const {
  if (grasp.tool != Tool::spring || workbench_.massless(grasp.object)) return make_fork(grasp, now);
  const RigidTransform& X_WO = workbench_.states()[grasp.object].X_WO;
  const double rest_length = std::max((X_WO.translation() - grasp.X_WS.translation()).norm(), least_rest_length);
  return std::make_unique<SpringBody>(workbench_.scene_index(grasp.object), workbench_.body(grasp.object),
                                      scene_.gravity, X_WO, rest_length, settings_.fork);
}

}  // namespace spring_workbench
