#include "paper.h"

#include <algorithm>
#include <cmath>

#include "constants.h"
#include "spring_workbench/math/spatial.h"
#include "spring_workbench/rod/static_deformation.h"

namespace spring_workbench::dynamics {
namespace {

/// The spring-damper of a DOF over a step.
struct SpringDamper {
  double inertia;  ///< [kg], of torsion [kg·m²]
  double omega_squared;
  math::OscillatorStep step;

  SpringDamper(double mu, double k, double c, double h)
      : inertia(mu), omega_squared(k / mu), step(math::damped_oscillator(0.5 * c / mu, k / mu, h)) {}
};

/// The spring-dampers of the active coordinates.
class SpringDampers {
 public:
  SpringDampers(const HeldBody& body, double h)
      : body_(body),
        bend_(body.body().mass, body.dof_stiffness().bend, body.dof_damping().bend, h),
        stretch_(body.body().mass, body.dof_stiffness().stretch, body.dof_damping().stretch, h),
        torsion_(body.axial_inertia(), body.dof_stiffness().torsion, body.dof_damping().torsion, h),
        unit_(body.shape().stiffness({1.0, 1.0, 1.0})) {}

  const SpringDamper& of(int i) const {
    const int c = body_.coordinates()[i];
    return c == body_.shape().stretch().begin ? stretch_ : c == body_.shape().torsion().begin ? torsion_ : bend_;
  }
  /// Generalised force per acceleration of the coordinate.
  double inertia(int i) const { return of(i).inertia * unit_[body_.coordinates()[i]]; }

 private:
  const HeldBody& body_;
  SpringDamper bend_, stretch_, torsion_;
  rod::StrainVector unit_;
};

/// The object's motion if the fork were rigid.
struct Carried {
  HandleState handle;
  motion::MotionState object;
  Matrix3d I_W;

  Carried(const HeldBody& body, const motion::Trajectory& motion, double t) : handle(body.state_at(motion, t)) {
    const StrainState straight = body.zero_state();
    object = body.object(handle, straight, &straight.q);
    I_W = object.X.linear() * body.body().inertia_O * object.X.linear().transpose();
  }
  Vector3d angular_momentum() const { return I_W * object.velocity.angular; }
  /// Returns the load on the fork, axes of H, for given rates of velocity [m/s²] and angular momentum [N·m].
  Wrench load(const HeldBody& body, const Vector3d& a, const Vector3d& moment) const {
    const Matrix3d R_HW = handle.X_WH.linear().transpose();
    return {-body.body().mass * (R_HW * (a + body.gravity() * Vector3d::UnitZ())), -(R_HW * moment)};
  }
  Wrench load(const HeldBody& body) const {  ///< at this moment
    return load(body, object.acceleration.linear,
                I_W * object.acceleration.angular + object.velocity.angular.cross(angular_momentum()));
  }
};

/// The collision check (section 5): if the object touches something on its path to the target, halvings cut the target
/// back. The last one that touches is used, so that the object reaches the contact, which then carries its load.
rod::StrainVector cut_back(const HeldBody& body, const Carried& begin, const Carried& end, const StrainState& state,
                           const rod::StrainVector& target) {
  const auto pose = [&](const HandleState& handle, const rod::StrainVector& q) {
    return body.object(handle, {q, rod::StrainVector::Zero(q.size())}).X;
  };
  const RigidTransform here = pose(begin.handle, state.q);
  const auto candidate = [&](double share) { return rod::StrainVector(state.q + share * (target - state.q)); };
  const auto is_free = [&](double share) { return body.path_check()(here, pose(end.handle, candidate(share))); };
  if (is_free(1.0)) return target;
  double free = 0.0, touching = 1.0;
  for (int i = 0; i < collision_halvings; ++i) {
    const double middle = 0.5 * (free + touching);
    (is_free(middle) ? free : touching) = middle;
  }
  return candidate(touching);
}

}  // namespace

StepEstimate Paper::step(const HeldBody& body, const motion::Trajectory& handle, double t, double h,
                         StrainState& state) {
  if (body.coupled()) return shared_.step(body, handle, t, h, state);
  const Carried begin(body, handle, t), end(body, handle, t + h);
  const Wrench load = end.load(body, (end.object.velocity.linear - begin.object.velocity.linear) / h,
                               (end.angular_momentum() - begin.angular_momentum()) / h);
  rod::StaticDeformation::Active active{};
  for (int i = 0; i < body.size(); ++i) active[static_cast<std::size_t>(body.coordinates()[i])] = true;
  const rod::StaticDeformation deformation(body.shape(), body.shape().stiffness(body.dof_stiffness()), active,
                                           body.body().X_OE.inverse().translation(), load);
  // A step that is repeated starts its search where it did before.
  if (version_ != body.version()) from_ = state.q;
  if (version_ == body.version() && t != t_) from_ = target_;
  t_ = t;
  const rod::EquilibriumStrain rest = deformation.under_load(body.full_state(t + h, {from_, 0.0 * from_}).q);
  target_ = body.coordinates().gather(rest.q);
  version_ = target_.allFinite() ? body.version() : -1;  // otherwise the next search must not start there

  const SpringDampers dampers(body, h);
  const rod::StrainVector candidate = body.path_check() ? cut_back(body, begin, end, state, target_) : target_;
  // Contact acts on the spring-dampers; so does the load on a coordinate without stiffness.
  const Matrix3d R_HW = end.handle.X_WH.linear().transpose();
  const rod::StrainVector pushed = body.object_jacobian(t + h, state.q).transpose() *
                                   to_vector(Wrench{R_HW * body.load().force, R_HW * body.load().moment});
  const rod::StrainVector free = body.coordinates().gather(deformation.force(rest.q));
  // Errors: one constant load stands for one that changes over the step; and the target's equilibrium is approximate.
  const Vector6d of_step = to_vector(load), first = to_vector(begin.load(body)), last = to_vector(end.load(body));
  rod::StrainMatrix off(rest.q.size(), 2);
  off.col(0) = deformation.force(rest.q, of_step - (2.0 * first + last) / 3.0) + rest.imbalance;
  off.col(1) = deformation.force(rest.q, of_step - 0.5 * (first + last)) + rest.imbalance;
  const rod::StrainMatrix target_off = rest.compliance * off;
  StepEstimate estimate{state.q, 0.0, state.q};
  for (int i = 0; i < body.size(); ++i) {
    const SpringDamper& d = dampers.of(i);
    const int c = body.coordinates()[i];
    const bool springs = d.omega_squared > 0.0;
    const double mu = dampers.inertia(i);
    const double pull = (springs ? d.omega_squared * candidate[i] : free[i] / mu) + pushed[i] / mu;
    d.step.carry(state.q[i], state.q_dot[i]);
    state.q[i] += d.step.xg * pull;
    state.q_dot[i] += d.step.vg * pull;
    estimate.q_error[i] = d.step.xg * (springs ? d.omega_squared * target_off(c, 0) : off(c, 0) / mu);
    estimate.q_dot_error[i] = d.step.vg * (springs ? d.omega_squared * target_off(c, 1) : off(c, 1) / mu);
  }
  return estimate;
}

void Paper::propagate_deviation(const HeldBody& body, const motion::Trajectory& handle, double t, double h,
                                const StrainState& begin, const StrainState& end, StrainState& deviation) {
  if (body.coupled()) return shared_.propagate_deviation(body, handle, t, h, begin, end, deviation);
  const SpringDampers dampers(body, h);  // their target does not depend on the state
  for (int i = 0; i < body.size(); ++i) dampers.of(i).step.carry(deviation.q[i], deviation.q_dot[i]);
}

Integrator::Response Paper::response(const HeldBody& body, const HandleState& handle, double h,
                                     const StrainState& state) {
  if (body.coupled()) return shared_.response(body, handle, h, state);
  const SpringDampers dampers(body, h);
  Response r{rod::StrainMatrix::Zero(body.size(), body.size()), rod::StrainMatrix::Zero(body.size(), body.size())};
  for (int i = 0; i < body.size(); ++i) {
    r.q(i, i) = dampers.of(i).step.xg / dampers.inertia(i);
    r.q_dot(i, i) = dampers.of(i).step.vg / dampers.inertia(i);
  }
  return r;
}

}  // namespace spring_workbench::dynamics
