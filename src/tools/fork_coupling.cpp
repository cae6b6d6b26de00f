#include "fork_coupling.h"

#include <cmath>

#include "constants.h"

namespace spring_workbench::tools {
ForkCoupling::ForkCoupling(const dynamics::HeldBody& held, double since)
    : held_(held),
      since_(since),
      R_OE_(math::mat3x3(held.body().X_OE.linear())),
      p_OE_(math::vec3(held.body().X_OE.translation())) {
  if (held.shape().size() == n) {
    shape_ = held.shared_shape();
    in_shape_ = {0, 1, 2, 3, 4, 5};
  } else {  // a constant curvature is a linear one with zero second terms
    shape_ = rod::make_shape_model(rod::ShapeKind::linear, held.shape().length());
    in_shape_ = {0, 2, 4, 5, -1, -1};
  }
}

void ForkCoupling::stiffen() {
  if (version_ == held_.version()) return;
  version_ = held_.version();
  const dynamics::HeldBody all_on(shape_, held_.body(), held_.gravity());
  const rod::StrainVector mass = all_on.mass_matrix(0.0, rod::StrainVector::Zero(n)).diagonal();
  D_.setZero();
  for (int i = 0; i < n; ++i) {
    K_[static_cast<std::size_t>(i)] = mass[i] * rigid_rate * rigid_rate;
    D_(i, i) = 2.0 * mass[i] * rigid_rate;
  }
  const rod::StrainVector K = held_.stiffness();
  const rod::StrainMatrix D = held_.damping();
  const auto at = [&](int i) { return in_shape_[static_cast<std::size_t>(held_.coordinates()[i])]; };
  for (int i = 0; i < held_.size(); ++i) {
    K_[static_cast<std::size_t>(at(i))] = K[i];
    for (int j = 0; j < held_.size(); ++j) D_(at(i), at(j)) = D(i, j);
  }
}

void ForkCoupling::set_strain(const rod::StrainVector& strain) {
  stiffen();
  start_.fill(0.0);
  for (Eigen::Index i = 0; i < strain.size(); ++i) {
    start_[static_cast<std::size_t>(in_shape_[static_cast<std::size_t>(i)])] = strain[i];
  }
}

void ForkCoupling::begin_step() const {
  for (std::size_t i = 0; i < n; ++i) warm_[i] = math::Pack{} + start_[i];
}

template <typename S>
struct ForkCoupling::Tip {
  rod::TipFit<S> fit;
  math::Vec3<S> r_OE;  ///< in handle axes
};

template <typename S>
ForkCoupling::Tip<S> ForkCoupling::tip(const dynamics::RelativeMotion<S>& A_O, const Coordinates<S>& start) const {
  const math::Vec3<S> r = A_O.R_AB * p_OE_;
  return {
      rod::TipFit<S>(*shape_, A_O.R_AB * R_OE_, A_O.p_AB + r, A_O.v_AB + cross(A_O.w_AB, r), A_O.w_AB, start.data()),
      r};
}

template <typename S>
void ForkCoupling::take_returns(const S& t, S* q, S* q_dot) const {
  if (!held_.returning()) return;
  for (int k = 0; k < math::lanes<S>; ++k) {
    const dynamics::StrainState returns = held_.full_state(math::lane(t, k), held_.zero_state());
    for (Eigen::Index i = 0; i < returns.q.size(); ++i) {
      const int c = in_shape_[static_cast<std::size_t>(i)];
      math::set_lane(q[c], k, math::lane(q[c], k) - returns.q[i]);
      math::set_lane(q_dot[c], k, math::lane(q_dot[c], k) - returns.q_dot[i]);
    }
  }
}

template <typename S>
void ForkCoupling::pull_of(const S& t, const dynamics::RelativeMotion<S>& A_O, Coordinates<S>& warm,
                           dynamics::Pull<S>& pull) const {
  Tip<S> at = tip(A_O, warm);
  bool found = true;
  for (int i = 0; i < n; ++i) {
    for (int k = 0; k < math::lanes<S>; ++k) found = found && std::isfinite(math::lane(at.fit.q[i], k));
  }
  for (std::size_t i = 0; i < n && found; ++i) warm[i] = at.fit.q[i];
  S q[n], q_dot[n], generalised[n];
  for (int i = 0; i < n; ++i) {
    q[i] = at.fit.q[i];
    q_dot[i] = at.fit.q_dot[i];
  }
  take_returns(t, q, q_dot);
  for (int i = 0; i < n; ++i) {
    generalised[i] = -K_[static_cast<std::size_t>(i)] * q[i];
    for (int j = 0; j < n; ++j) generalised[i] -= D_(i, j) * q_dot[j];
  }
  at.fit.wrench(generalised, pull.force, pull.moment);
  pull.moment += cross(at.r_OE, pull.force);
}

void ForkCoupling::pull(const double& t, const dynamics::RelativeMotion<double>& A_O,
                        dynamics::Pull<double>& pull) const {
  Coordinates<double> start = start_;
  pull_of(t, A_O, start, pull);
}

void ForkCoupling::pull(const math::Pack& t, const dynamics::RelativeMotion<math::Pack>& A_O,
                        dynamics::Pull<math::Pack>& pull) const {
  pull_of(t, A_O, warm_, pull);
}

dynamics::Coupling::Springs ForkCoupling::springs(double t, const dynamics::RelativeMotion<double>& A_O) const {
  Tip<double> at = tip(A_O, start_);
  // Columns: wrench on the object for a unit force of each coordinate.
  Matrix6d to_object;
  for (int i = 0; i < n; ++i) {
    double unit[n] = {};
    unit[i] = 1.0;
    math::Vec3<double> force{}, moment{};
    at.fit.wrench(unit, force, moment);
    to_object.col(i) << math::vector(force), math::vector(moment + cross(at.r_OE, force));
  }
  const Vector6d K = Eigen::Map<const Vector6d>(K_.data());
  Springs s;
  s.stiffness = to_object * K.asDiagonal() * to_object.transpose();
  s.damping = to_object * D_ * to_object.transpose();
  const Vector6d rate = Eigen::Map<const Vector6d>(at.fit.q_dot);
  take_returns(t, at.fit.q, at.fit.q_dot);
  const Vector6d q = Eigen::Map<const Vector6d>(at.fit.q), q_dot = Eigen::Map<const Vector6d>(at.fit.q_dot);
  s.energy = 0.5 * q.dot(K.cwiseProduct(q));
  // Power that enters at the tip and is not stored: in the dampers, and in DOFs that return to zero strain.
  s.dissipated_power = rate.dot(K.cwiseProduct(q) + D_ * q_dot) - q_dot.dot(K.cwiseProduct(q));
  return s;
}

ForkCoupling::Following ForkCoupling::follow(const dynamics::RelativeMotion<double>& A_O) const {
  const Tip<double> at = tip(A_O, start_);
  dynamics::StrainState state = held_.zero_state();
  for (int i = 0; i < held_.size(); ++i) {
    const int c = in_shape_[static_cast<std::size_t>(held_.coordinates()[i])];
    state.q[i] = at.fit.q[c];
    state.q_dot[i] = at.fit.q_dot[c];
  }
  RigidTransform X_HE = RigidTransform::Identity(), X_PE = X_HE;
  X_HE.linear() = math::matrix(A_O.R_AB * R_OE_, 0);
  X_HE.translation() = math::vector(A_O.p_AB + at.r_OE);
  X_PE.linear() = math::matrix(at.fit.tip.R_HE, 0);
  X_PE.translation() = math::vector(at.fit.tip.p_HE);
  return {state, X_HE * X_PE.inverse()};
}

}  // namespace spring_workbench::tools
