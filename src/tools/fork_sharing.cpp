// The fork as one of several tools on an object.
#include <Eigen/Cholesky>
#include <Eigen/QR>

#include "constants.h"
#include "fork_body.h"
#include "spring_workbench/math/so3.h"

namespace spring_workbench::tools {
namespace {

/// From `X0` to `X1`, at the origin of `X0`, world axes.
Vector6d difference(const RigidTransform& X0, const RigidTransform& X1) {
  Vector6d d;
  d << X1.translation() - X0.translation(), math::log_so3(X1.linear() * X0.linear().transpose());
  return d;
}

}  // namespace

bodies::Coupling ForkBody::coupling(double h, const RigidTransform& X_WO, const Matrix6d& mobility) const {
  const double t = state_.t + h;
  const dynamics::HandleForcing handle = held_.forcing(hand_, t);
  const dynamics::StrainState still{state_.strain.q, rod::StrainVector::Zero(held_.size())};
  bodies::Coupling c;
  c.directions.setIdentity(6, 6);
  // Where the object had to leave the hand behind, the gap closes as it does on one fork alone.
  c.relaxed = difference(X_WO, returned_offset(h) * held_.object(handle, still).X);
  c.compliance = Matrix6d::Zero();
  if (held_.size() < rod::max_strain_coordinates) c.compliance = rigid_share * h * h * mobility;
  if (held_.size() == 0) return c;
  // Kelvin and Voigt over the step: (K + D / h) δq = −∂U/∂q − Jᵀ (wrench on the object).
  const Jacobian J = jacobian_W(handle.X_WH.linear(), t);
  rod::StrainMatrix stiffness = held_.damping() / h;
  stiffness.diagonal() += held_.stiffness();
  stiffness.diagonal() += least_stiffness / (h * h) * held_.mass_matrix(t, state_.strain.q).diagonal();
  const Eigen::LLT<rod::StrainMatrix> give(stiffness);
  c.relaxed -= J * give.solve(held_.elastic_force(t, state_.strain.q));
  c.compliance += J * give.solve(J.transpose());
  return c;
}

/// With fewer than six coordinates, springs and what gives way beside them share the difference as they do in
/// coupling().
void ForkBody::fit(const dynamics::HandleForcing& handle, const RigidTransform& X_WO, double h) {
  const int n = held_.size();
  if (n == 0) return;
  dynamics::StrainState tried{state_.strain.q, rod::StrainVector::Zero(n)};
  const Matrix3d& R = X_WO.linear();
  // Stiffness of what gives way beside the springs.
  const Matrix6d beside =
      spatial_matrix(held_.body().mass, R * held_.body().inertia_O * R.transpose()) / (rigid_share * h * h);
  const Matrix6d root = beside.llt().matrixU();
  const rod::StrainVector springs = held_.stiffness().cwiseSqrt() * (n < rod::max_strain_coordinates ? 1.0 : 0.0);
  for (int iteration = 0; iteration < most_fit_iterations; ++iteration) {
    const Vector6d missing = difference(held_.object(handle, tried).X, X_WO);
    Eigen::MatrixXd left(6 + n, n);
    Eigen::VectorXd right(6 + n);
    left << root * jacobian_W(handle.X_WH.linear(), state_.t), Eigen::MatrixXd(springs.asDiagonal());
    right << root * missing, -springs.cwiseProduct(tried.q);
    const rod::StrainVector change = left.colPivHouseholderQr().solve(right);
    tried.q += change;
    if (!tried.q.allFinite() || !held_.shape().admissible(held_.full_state(state_.t, tried).q)) return;
    state_.strain.q = tried.q;
    if (held_.shape().length() * change.cwiseAbs().maxCoeff() < fitted) return;
  }
}

void ForkBody::follow(double h, const motion::MotionState& object, const Wrench& pull_W) {
  sleep_ = Sleep();
  state_.stepping = dynamics::StepControl::Memory();
  state_.t += h;
  state_.pull_W = pull_W;
  held_.drop_finished_returns(state_.t);
  const dynamics::HandleForcing hand = held_.forcing(hand_, state_.t);
  fit(hand, object.X, h);
  const dynamics::StrainState still{state_.strain.q, rod::StrainVector::Zero(held_.size())};
  const RigidTransform offset = object.X * held_.object(hand, still).X.inverse();
  state_.behind = (offset.matrix() - RigidTransform::Identity().matrix()).cwiseAbs().maxCoeff() > no_offset;
  state_.offset = state_.behind ? offset : RigidTransform::Identity();
  state_.strain.q_dot = held_.project_twist(state_.behind ? handle() : hand, state_.strain.q, object.velocity);
}

}  // namespace spring_workbench::tools
