#include "spring_workbench/tools/calibration.h"

#include <algorithm>
#include <cmath>

#include "constants.h"
#include "spring_workbench/math/so3.h"
#include "spring_workbench/math/spatial.h"
#include "spring_workbench/scene/constants.h"
#include "spring_workbench/stepping/find_strain.h"

namespace spring_workbench::tools {
namespace {

/// A body of 1 kg at rest on a fork with all degrees of freedom. All forces are proportional to the mass, so its
/// stiffness is the stiffness per kilogram.
class UnitMassOnFork {
 public:
  /// `turn`: rotation vector of the handle in world.
  UnitMassOnFork(const std::shared_ptr<const rod::ShapeModel>& shape, const dynamics::BodyInertia& body, double gravity,
                 const Vector3d& turn)
      : held_(shape, {1.0, body.inertia_O / body.mass, body.X_OE}, gravity),
        q_(rod::StrainVector::Zero(shape->size())) {
    held_.set_dofs({true, true, true}, 0.0, 1.0, {q_, q_});
    X_WH_.linear() = math::exp_so3(turn);
  }

  /// Finds the equilibrium for these springs, starting from the last one.
  void settle(const rod::PerDof& k) {
    held_.set_springs(k, {1.0, 1.0, 1.0});
    const dynamics::HandleState handle = held_.state_at(motion::MotionSegment(X_WH_), 0.0);
    const auto force = [&](const rod::StrainVector& at) -> rod::StrainVector {
      return held_.mass_matrix(0.0, at) * held_.acceleration(handle, at, rod::StrainVector::Zero(at.size()));
    };
    q_ = stepping::find_strain(held_, 0.0, force, q_).q;
  }
  double extension() const { return std::abs(held_.shape().extension(q_)); }  ///< [m]
  double deflection() const {                                                 ///< of the tip [m]
    return held_.shape().section(q_, held_.shape().length()).translation().head<2>().norm();
  }
  double twist() const { return std::abs(held_.shape().torsion_angle(q_)); }  ///< [rad]
  double axial_inertia() const { return held_.axial_inertia(); }              ///< [kg·m²]

 private:
  dynamics::HeldBody held_;
  RigidTransform X_WH_ = RigidTransform::Identity();
  rod::StrainVector q_;
};

const Vector3d hanging(M_PI, 0.0, 0.0);       // z of the handle is down
const Vector3d level(0.0, -0.5 * M_PI, 0.0);  // x of the handle is up

/// Finds the stiffness for which all values of `too_large` are 1: each is the ratio of a deformation to its goal, and
/// decreases with its own stiffness.
template <typename TooLarge>
rod::PerDof fit(rod::PerDof k, TooLarge&& too_large) {
  for (int iteration = 0; iteration < 40; ++iteration) {
    const rod::PerDof much = too_large(k);
    if (std::max({std::abs(much.stretch - 1.0), std::abs(much.bend - 1.0), std::abs(much.torsion - 1.0)}) < 1e-5) break;
    k.stretch *= std::clamp(much.stretch, 0.2, 5.0);
    k.bend *= std::clamp(much.bend, 0.2, 5.0);
    k.torsion *= std::clamp(much.torsion, 0.2, 5.0);
  }
  return k;
}

rod::PerDof scaled(double mass, const rod::PerDof& k) { return {mass * k.stretch, mass * k.bend, mass * k.torsion}; }

}  // namespace

double weighing_gravity(double gravity) { return gravity > 0.0 ? gravity : scene::default_gravity; }

rod::PerDof calibrated_stiffness(rod::ShapeKind shape, double length, const dynamics::BodyInertia& body, double gravity,
                                 const ObjectGoal& goal) {
  const double g = weighing_gravity(gravity), sag = goal.sag * length;
  const auto rod = rod::make_shape_model(shape, length);
  UnitMassOnFork down(rod, body, g, hanging), across(rod, body, g, level);
  return scaled(body.mass, fit({g / sag, g / sag, down.axial_inertia() * g / sag}, [&](const rod::PerDof& k) {
                  down.settle(k);
                  across.settle(k);
                  return rod::PerDof{down.extension() / sag, across.deflection() / sag, 1.0};
                }));
}

double calibrated_spring(double mass, double sag, double gravity) { return mass * weighing_gravity(gravity) / sag; }

double calibrated_length(const dynamics::BodyInertia& body, const ObjectGoal& goal) {
  const double own = radius_of_gyration(body.mass, body.inertia_O);
  const double of_water = std::sqrt(0.4) * std::cbrt(0.75 * body.mass / (M_PI * density_of_water));
  return std::clamp(2.0 * goal.twist * std::sqrt(own * of_water) / goal.sag, 1e-3, 100.0);
}

WorldLoad world_load(const scene::Scene& scene, const WorldGoal& goal) {
  WorldLoad load;
  double heaviest = 0.0;
  for (const scene::Body& body : scene.bodies) {
    const scene::MassProperties& m = body.mass_properties;
    if (m.mass <= heaviest) continue;
    heaviest = m.mass;
    load = {m.mass, radius_of_gyration(m.mass, m.inertia_O)};
  }
  load.mass = goal.heaviest.value_or(load.mass);
  return load;
}

rod::PerDof world_stiffness(const rod::ForkSettings& fork, const WorldLoad& load, double gravity,
                            const WorldGoal& goal) {
  const double g = weighing_gravity(gravity), L = fork.length;
  const auto rod = rod::make_shape_model(fork.shape, L, fork.slope_stiffness);
  const Matrix3d inertia = load.lever * load.lever * Matrix3d::Identity();
  dynamics::BodyInertia centred{1.0, inertia, RigidTransform::Identity()}, off_centre = centred;
  off_centre.X_OE.translation().y() = -load.lever;
  UnitMassOnFork down(rod, centred, g, hanging), across(rod, centred, g, level), twisted(rod, off_centre, g, level);
  const rod::PerDof first{g / (goal.stretch * L), g / (goal.bend * L), g * load.lever / goal.twist};
  return scaled(load.mass, fit(first, [&](const rod::PerDof& k) {
                  down.settle(k);
                  across.settle(k);
                  twisted.settle(k);
                  return rod::PerDof{down.extension() / (goal.stretch * L), across.deflection() / (goal.bend * L),
                                     twisted.twist() / goal.twist};
                }));
}

void damp_calibrated(rod::ForkSettings& fork) {
  if (fork.damping_ratio.uniform() && fork.damping_law == rod::DampingLaw::per_dof)
    fork.damping_law = rod::DampingLaw::modal;
}

}  // namespace spring_workbench::tools
