#include "spring_workbench/dynamics/held_body.h"

#include <Eigen/Cholesky>
#include <cmath>
#include <utility>

namespace spring_workbench {
namespace {

/// After this many time constants a critically damped return is over: exp(−45) is below the rounding of its start.
constexpr double return_is_over = 45.0;

}  // namespace

HeldBody::HeldBody(std::shared_ptr<const ShapeModel> shape, const BodyInertia& body, double gravity)
    : shape_(std::move(shape)), body_(body), gravity_(gravity) {
  p_OE_ = body.X_OE.translation();
  p_EO_ = -(body.X_OE.linear().transpose() * p_OE_);
  K_ = D_ = StrainVector::Zero(shape_->size());
  mode_.fill(Mode::active);
  changed();
}

void HeldBody::changed() {
  ++version_;
  active_count_ = 0;
  returning_ = 0;
  for (int i = 0; i < shape_->size(); ++i) {
    const auto c = static_cast<std::size_t>(i);
    if (mode_[c] == Mode::active) active_[static_cast<std::size_t>(active_count_++)] = i;
    if (mode_[c] == Mode::returning) ++returning_;
  }
}

double HeldBody::axial_inertia() const {
  const Vector3d axis = body_.X_OE.linear().col(2);
  return axis.dot(body_.inertia_O * axis) + body_.mass * axis.cross(p_OE_).squaredNorm();
}

void HeldBody::set_springs(const PerFamily& stiffness, const PerFamily& damping_ratio) {
  PerFamily c;
  c.stretch = 2.0 * damping_ratio.stretch * std::sqrt(body_.mass * stiffness.stretch);
  c.bend = 2.0 * damping_ratio.bend * std::sqrt(body_.mass * stiffness.bend);
  c.torsion = 2.0 * damping_ratio.torsion * std::sqrt(axial_inertia() * stiffness.torsion);
  set_springs_and_dampers(stiffness, c);
}

void HeldBody::set_springs_and_dampers(const PerFamily& stiffness, const PerFamily& damping) {
  K_ = shape_->stiffness(stiffness);
  D_ = shape_->stiffness(damping);  // (c_f / k_f) K_f, without dividing by k_f
  changed();
}

StrainState HeldBody::zero_state() const { return {StrainVector::Zero(size()), StrainVector::Zero(size())}; }

StrainVector HeldBody::stiffness() const {
  StrainVector K(size());
  for (int i = 0; i < size(); ++i) K[i] = K_[active_[static_cast<std::size_t>(i)]];
  return K;
}

StrainVector HeldBody::damping() const {
  StrainVector D(size());
  for (int i = 0; i < size(); ++i) D[i] = D_[active_[static_cast<std::size_t>(i)]];
  return D;
}

StrainState HeldBody::set_dofs(const ForkDofs& dofs, double t, double return_time, const StrainState& full) {
  const auto set_family = [&](const CoordinateRange& range, bool on) {
    for (int i = range.begin; i < range.begin + range.count; ++i) {
      const auto c = static_cast<std::size_t>(i);
      if (on) {
        mode_[c] = Mode::active;
      } else if (mode_[c] == Mode::active) {
        const bool strained = full.q[i] != 0.0 || full.q_dot[i] != 0.0;
        mode_[c] = strained ? Mode::returning : Mode::off;
        return_[c] = {t, return_time, full.q[i], full.q_dot[i]};
      }
    }
  };
  set_family(shape_->bend(), dofs.bend);
  set_family(shape_->torsion(), dofs.torsion);
  set_family(shape_->stretch(), dofs.stretch);
  changed();
  StrainState active = zero_state();
  for (int i = 0; i < size(); ++i) {
    active.q[i] = full.q[active_[static_cast<std::size_t>(i)]];
    active.q_dot[i] = full.q_dot[active_[static_cast<std::size_t>(i)]];
  }
  return active;
}

bool HeldBody::drop_finished_returns(double t) {
  bool dropped = false;
  for (std::size_t i = 0; i < static_cast<std::size_t>(shape_->size()) && returning_ > 0; ++i) {
    if (mode_[i] == Mode::returning && t - return_[i].t0 > return_is_over * return_[i].time_constant) {
      mode_[i] = Mode::off;
      dropped = true;
    }
  }
  if (dropped) changed();
  return dropped;
}

void HeldBody::prescribed(double t, StrainVector& q, StrainVector& q_dot, StrainVector& q_ddot) const {
  for (int i = 0; i < shape_->size(); ++i) {
    const auto c = static_cast<std::size_t>(i);
    if (mode_[c] != Mode::returning) continue;
    // (B + A τ) e^{−τ/T}: the paper's critically damped closed form (section 3.3).
    const Return& r = return_[c];
    const double rate = 1.0 / r.time_constant;
    const double tau = t - r.t0;
    const double decay = std::exp(-rate * tau);
    const double A = r.rate0 + rate * r.q0;
    q[i] = (r.q0 + A * tau) * decay;
    q_dot[i] = A * decay - rate * q[i];
    q_ddot[i] = -rate * A * decay - rate * q_dot[i];
  }
}

void HeldBody::set_external_wrench(const Wrench& wrench_W) {
  if (wrench_W.force == external_W_.force && wrench_W.moment == external_W_.moment) return;
  external_W_ = wrench_W;
  ++load_version_;
}

HandleForcing HeldBody::forcing(const MotionSegment& handle, double t) const {
  const MotionState s = handle.at(t);
  HandleForcing f;
  f.t = t;
  f.X_WH = s.X;
  f.v_WH_W = s.velocity.linear;
  const auto R_HW = s.X.linear().transpose();
  f.angular_velocity = R_HW * s.velocity.angular;
  f.angular_acceleration = R_HW * s.acceleration.angular;
  f.acceleration_less_gravity = R_HW * (s.acceleration.linear + gravity_ * Vector3d::UnitZ());
  return f;
}

void HeldBody::kinematics(double t, const StrainVector& q, const StrainVector& q_dot, Kinematics& k) const {
  k.q = k.q_dot = StrainVector::Zero(shape_->size());
  for (int i = 0; i < size(); ++i) {
    k.q[active_[static_cast<std::size_t>(i)]] = q[i];
    k.q_dot[active_[static_cast<std::size_t>(i)]] = q_dot[i];
  }
  StrainVector q_ddot;
  if (returning_ > 0) {
    q_ddot = StrainVector::Zero(shape_->size());
    prescribed(t, k.q, k.q_dot, q_ddot);
  }
  shape_->tip(k.q, k.q_dot, k.tip);
  k.r_EO = k.tip.R_HE * p_EO_;
  k.p_HO = k.tip.p_HE + k.r_EO;
  k.R_HO = k.tip.R_HE * body_.X_OE.linear().transpose();
  k.linear.resize(3, shape_->size());
  for (int i = 0; i < shape_->size(); ++i) k.linear.col(i) = k.tip.linear.col(i) + k.tip.angular.col(i).cross(k.r_EO);
  const Vector3d w = k.tip.angular * k.q_dot;
  k.angular_bias = k.tip.angular_bias;
  k.linear_bias = k.tip.linear_bias + k.tip.angular_bias.cross(k.r_EO) + w.cross(w.cross(k.r_EO));
  if (returning_ > 0) {
    k.angular_bias += k.tip.angular * q_ddot;
    k.linear_bias += k.linear * q_ddot;
  }
}

StrainMatrix HeldBody::mass_matrix(const Kinematics& k, Matrix3d& I_H) const {
  I_H = k.R_HO * body_.inertia_O * k.R_HO.transpose();
  const int n = size();
  StrainMatrix M(n, n);
  for (int j = 0; j < n; ++j) {
    const int cj = active_[static_cast<std::size_t>(j)];
    const Vector3d momentum = body_.mass * k.linear.col(cj);
    const Vector3d angular_momentum = I_H * k.tip.angular.col(cj);
    for (int i = 0; i <= j; ++i) {
      const int ci = active_[static_cast<std::size_t>(i)];
      M(i, j) = M(j, i) = k.linear.col(ci).dot(momentum) + k.tip.angular.col(ci).dot(angular_momentum);
    }
  }
  return M;
}

StrainVector HeldBody::acceleration(const HandleForcing& h, const StrainVector& q, const StrainVector& q_dot) const {
  Kinematics k;
  kinematics(h.t, q, q_dot, k);
  Matrix3d I_H;
  const StrainMatrix M = mass_matrix(k, I_H);
  // Velocities and accelerations of O for q̈ = 0, in the axes of the turning frame H.
  const Vector3d w_rel = k.tip.angular * k.q_dot;
  const Vector3d v_rel = k.linear * k.q_dot;
  const Vector3d& w_H = h.angular_velocity;
  const Vector3d w = w_H + w_rel;
  const Vector3d a = h.acceleration_less_gravity + h.angular_acceleration.cross(k.p_HO) +
                     w_H.cross(w_H.cross(k.p_HO)) + 2.0 * w_H.cross(v_rel) + k.linear_bias;
  const Vector3d alpha = h.angular_acceleration + w_H.cross(w_rel) + k.angular_bias;
  const auto R_HW = h.X_WH.linear().transpose();
  const Vector3d force = body_.mass * a - R_HW * external_W_.force;
  const Vector3d moment = I_H * alpha + w.cross(I_H * w) - R_HW * external_W_.moment;

  StrainVector rhs(size());
  for (int i = 0; i < size(); ++i) {
    const int c = active_[static_cast<std::size_t>(i)];
    rhs[i] = -K_[c] * k.q[c] - D_[c] * k.q_dot[c] - k.linear.col(c).dot(force) - k.tip.angular.col(c).dot(moment);
  }
  return M.llt().solve(rhs);
}

StrainMatrix HeldBody::mass_matrix(double t, const StrainVector& q) const {
  Kinematics k;
  kinematics(t, q, StrainVector::Zero(size()), k);
  Matrix3d I_H;
  return mass_matrix(k, I_H);
}

StrainState HeldBody::full_state(double t, const StrainState& state) const {
  StrainState full{StrainVector::Zero(shape_->size()), StrainVector::Zero(shape_->size())};
  for (int i = 0; i < size(); ++i) {
    full.q[active_[static_cast<std::size_t>(i)]] = state.q[i];
    full.q_dot[active_[static_cast<std::size_t>(i)]] = state.q_dot[i];
  }
  if (returning_ > 0) {
    StrainVector q_ddot = StrainVector::Zero(shape_->size());
    prescribed(t, full.q, full.q_dot, q_ddot);
  }
  return full;
}

bool HeldBody::rechart(StrainState& state) const {
  if (returning_ > 0) return false;
  StrainState full = full_state(0.0, state);
  if (!shape_->rechart(full.q, full.q_dot)) return false;
  for (int i = 0; i < size(); ++i) {
    const int c = active_[static_cast<std::size_t>(i)];
    state.q[i] = full.q[c];
    state.q_dot[i] = full.q_dot[c];
  }
  return true;
}

MotionState HeldBody::object(const HandleForcing& h, const StrainState& state, const StrainVector* q_ddot) const {
  Kinematics k;
  kinematics(h.t, state.q, state.q_dot, k);
  const Matrix3d& R_WH = h.X_WH.linear();
  const Vector3d& w_H = h.angular_velocity;
  const Vector3d w_rel = k.tip.angular * k.q_dot;
  const Vector3d v_rel = k.linear * k.q_dot;
  MotionState s;
  s.X.linear() = R_WH * k.R_HO;
  s.X.translation() = h.X_WH * k.p_HO;
  s.velocity.linear = h.v_WH_W + R_WH * (w_H.cross(k.p_HO) + v_rel);
  s.velocity.angular = R_WH * (w_H + w_rel);
  if (q_ddot != nullptr) {
    Vector3d a = h.acceleration_less_gravity + h.angular_acceleration.cross(k.p_HO) + w_H.cross(w_H.cross(k.p_HO)) +
                 2.0 * w_H.cross(v_rel) + k.linear_bias;
    Vector3d alpha = h.angular_acceleration + w_H.cross(w_rel) + k.angular_bias;
    for (int i = 0; i < size(); ++i) {
      const int c = active_[static_cast<std::size_t>(i)];
      a += k.linear.col(c) * (*q_ddot)[i];
      alpha += k.tip.angular.col(c) * (*q_ddot)[i];
    }
    s.acceleration.linear = R_WH * a - gravity_ * Vector3d::UnitZ();
    s.acceleration.angular = R_WH * alpha;
  }
  return s;
}

Eigen::Matrix<double, 6, Eigen::Dynamic, 0, 6, max_strain_coordinates> HeldBody::object_jacobian(
    double t, const StrainVector& q) const {
  Kinematics k;
  kinematics(t, q, StrainVector::Zero(size()), k);
  Eigen::Matrix<double, 6, Eigen::Dynamic, 0, 6, max_strain_coordinates> J(6, size());
  for (int i = 0; i < size(); ++i) {
    const int c = active_[static_cast<std::size_t>(i)];
    J.col(i) << k.linear.col(c), k.tip.angular.col(c);
  }
  return J;
}

StrainVector HeldBody::project_twist(const HandleForcing& h, const StrainVector& q, const Twist& V_WO_W) const {
  if (size() == 0) return StrainVector::Zero(0);
  const StrainVector zero = StrainVector::Zero(size());
  const MotionState carried = object(h, {q, zero});
  Kinematics k;
  kinematics(h.t, q, zero, k);
  Matrix3d I_H;
  const StrainMatrix M = mass_matrix(k, I_H);
  const auto R_HW = h.X_WH.linear().transpose();
  const Vector3d momentum = body_.mass * (R_HW * (V_WO_W.linear - carried.velocity.linear));
  const Vector3d angular_momentum = I_H * (R_HW * (V_WO_W.angular - carried.velocity.angular));
  StrainVector p(size());
  for (int i = 0; i < size(); ++i) {
    const int c = active_[static_cast<std::size_t>(i)];
    p[i] = k.linear.col(c).dot(momentum) + k.tip.angular.col(c).dot(angular_momentum);
  }
  return M.llt().solve(p);
}

double HeldBody::elastic_energy(double t, const StrainState& state) const {
  const StrainState full = full_state(t, state);
  return 0.5 * full.q.dot(K_.cwiseProduct(full.q));
}

double HeldBody::kinetic_energy(const Twist& V, const Matrix3d& R_WO) const {
  const Vector3d w_O = R_WO.transpose() * V.angular;
  return 0.5 * body_.mass * V.linear.squaredNorm() + 0.5 * w_O.dot(body_.inertia_O * w_O);
}

}  // namespace spring_workbench
