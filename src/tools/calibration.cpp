#include "spring_workbench/tools/calibration.h"

#include <algorithm>
#include <cmath>

#include "find_strain.h"
#include "spring_workbench/math/so3.h"
#include "spring_workbench/math/spatial.h"
#include "spring_workbench/scene/constants.h"

namespace spring_workbench::tools {
namespace {

/// The strain at rest on a handle at `X_WH`, looked for from `q` on.
rod::StrainVector equilibrium(const dynamics::HeldBody& held, const RigidTransform& X_WH, const rod::StrainVector& q) {
  const dynamics::HandleForcing handle = held.forcing(motion::MotionSegment(X_WH), 0.0);
  const auto force = [&](const rod::StrainVector& at) -> rod::StrainVector {
    return held.mass_matrix(0.0, at) * held.acceleration(handle, at, rod::StrainVector::Zero(at.size()));
  };
  return find_strain(held, 0.0, force, q, 1e-10 * held.gravity());
}

}  // namespace

double weighing_gravity(double gravity) { return gravity > 0.0 ? gravity : scene::standard_gravity; }

rod::PerDof calibrated_stiffness(rod::ShapeKind shape, double length, const dynamics::BodyInertia& body, double gravity,
                                 const CalibrationGoal& goal) {
  const double g = weighing_gravity(gravity);
  const double sag = goal.sag * length;
  const double omega = std::sqrt(g / sag);
  // Of a body of 1 kg: all forces are proportional to the mass.
  const dynamics::BodyInertia unit{1.0, body.inertia_O / body.mass, body.X_OE};
  dynamics::HeldBody held(rod::make_shape_model(shape, length), unit, g);
  const int size = held.shape().size();
  const dynamics::StrainState zero{rod::StrainVector::Zero(size), rod::StrainVector::Zero(size)};
  held.set_dofs({true, true, true}, 0.0, 1.0, zero);
  RigidTransform hanging = RigidTransform::Identity(), level = RigidTransform::Identity();
  hanging.linear() = math::exp_so3(Vector3d(M_PI, 0.0, 0.0));       // z of the handle is down
  level.linear() = math::exp_so3(Vector3d(0.0, -0.5 * M_PI, 0.0));  // x of the handle is up
  rod::PerDof k{g / sag, g / sag, held.axial_inertia() * omega * omega};
  rod::StrainVector q_hanging = zero.q, q_level = zero.q;
  for (int iteration = 0; iteration < 40; ++iteration) {
    held.set_springs(k, {1.0, 1.0, 1.0});
    q_hanging = equilibrium(held, hanging, q_hanging);
    q_level = equilibrium(held, level, q_level);
    const double extension = std::abs(held.shape().extension(q_hanging)) / sag;
    const double deflection = held.shape().section(q_level, length).translation().head<2>().norm() / sag;
    if (std::max(std::abs(extension - 1.0), std::abs(deflection - 1.0)) < 1e-5) break;
    k.stretch *= std::clamp(extension, 0.2, 5.0);
    k.bend *= std::clamp(deflection, 0.2, 5.0);
  }
  return {body.mass * k.stretch, body.mass * k.bend, body.mass * k.torsion};
}

double calibrated_spring(double mass, double length, double gravity, const CalibrationGoal& goal) {
  return mass * weighing_gravity(gravity) / (goal.sag * length);
}

double calibrated_length(const dynamics::BodyInertia& body, const CalibrationGoal& goal) {
  const double gyration = radius_of_gyration(body.mass, body.inertia_O);
  return std::clamp(2.0 * goal.twist * gyration / goal.sag, 1e-3, 100.0);
}

}  // namespace spring_workbench::tools
