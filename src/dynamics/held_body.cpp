#include "spring_workbench/dynamics/held_body.h"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <Eigen/SVD>
#include <cmath>
#include <utility>

namespace spring_workbench::dynamics {
namespace {

/// After this many time constants a critically damped return is over: exp(−45) is below the rounding of its start.
constexpr double return_is_over = 45.0;

/// `2 ζ M^½ (M^-½ K M^-½)^½ M^½` for a diagonal `K`: of the stiff coordinates 2 ζ K^½ (K^½ M⁻¹ K^½)^-½ K^½, from the
/// singular values of L⁻¹ K^½ with M = L Lᵀ. So soft coordinates keep their digits beside stiff ones; without stiffness
/// no damping.
rod::StrainMatrix modal_damping(const rod::StrainMatrix& M, const rod::StrainVector& K, double ratio) {
  const Eigen::Index n = K.size();
  rod::StrainMatrix root = rod::StrainMatrix::Zero(n, n);  // its first `stiff` columns
  Eigen::Index stiff = 0;
  for (Eigen::Index i = 0; i < n; ++i) {
    if (K[i] > 0.0) root(i, stiff++) = std::sqrt(K[i]);
  }
  if (stiff == 0) return root;
  root.conservativeResize(n, stiff);
  const rod::StrainMatrix of_modes = M.llt().matrixL().solve(root);
  const Eigen::JacobiSVD<rod::StrainMatrix> modes(of_modes, Eigen::ComputeFullV);
  return 2.0 * ratio * root * modes.matrixV() * modes.singularValues().cwiseInverse().asDiagonal() *
         modes.matrixV().transpose() * root.transpose();
}

}  // namespace

HeldBody::HeldBody(std::shared_ptr<const rod::ShapeModel> shape, const BodyInertia& body, double gravity)
    : shape_(std::move(shape)), body_(body), gravity_(gravity) {
  p_OE_ = body.X_OE.translation();
  p_EO_ = -(body.X_OE.linear().transpose() * p_OE_);
  R_EO_ = body.X_OE.linear().transpose();
  inertia_E_ = R_EO_ * body.inertia_O * R_EO_.transpose();
  inverse_inertia_O_ = body.inertia_O.inverse();
  shape_size_ = shape_->size();
  K_ = D_ = rod::StrainVector::Zero(shape_size_);
  mode_.fill(Mode::active);
  changed();
}

void HeldBody::changed() {
  ++version_;
  take_modes();
}

void HeldBody::exchange(math::StateArchive& state) {
  state(version_, load_version_, K_, D_, modal_, modal_ratio_, mode_, return_, external_W_, loaded_);
  if (state.sets()) take_modes();
}

void HeldBody::take_modes() {
  active_count_ = 0;
  returning_ = 0;
  for (int i = 0; i < shape_->size(); ++i) {
    const auto c = static_cast<std::size_t>(i);
    if (mode_[c] == Mode::active) active_[static_cast<std::size_t>(active_count_++)] = i;
    if (mode_[c] == Mode::returning) ++returning_;
  }
  if (active_count_ == 1) {
    const rod::StrainVector one = rod::StrainVector::Ones(shape_size_);
    axial_unit_ = active_[0] == shape_->stretch().begin ? shape_->extension(one) : shape_->twist(one);
  }
  if (!modal_) return;
  Kinematics unstrained;
  unstrained.q = unstrained.q_dot = rod::StrainVector::Zero(shape_size_);
  kinematics(unstrained);
  Matrix3d I_H;
  D_modal_ = modal_damping(mass_matrix(unstrained, I_H), stiffness(), modal_ratio_);
}

double HeldBody::axial_inertia() const {
  const Vector3d axis = body_.X_OE.linear().col(2);
  return axis.dot(body_.inertia_O * axis) + body_.mass * axis.cross(p_OE_).squaredNorm();
}

void HeldBody::set_springs(const rod::PerDof& stiffness, const rod::PerDof& damping_ratio) {
  rod::PerDof c;
  c.stretch = 2.0 * damping_ratio.stretch * std::sqrt(body_.mass * stiffness.stretch);
  c.bend = 2.0 * damping_ratio.bend * std::sqrt(body_.mass * stiffness.bend);
  c.torsion = 2.0 * damping_ratio.torsion * std::sqrt(axial_inertia() * stiffness.torsion);
  set_springs_and_dampers(stiffness, c);
}

void HeldBody::set_springs_and_dampers(const rod::PerDof& stiffness, const rod::PerDof& damping) {
  K_ = shape_->stiffness(stiffness);
  D_ = shape_->damping(damping, stiffness);
  modal_ = false;
  changed();
}

void HeldBody::set_springs_with_modal_damping(const rod::PerDof& stiffness, double damping_ratio) {
  set_springs_and_dampers(stiffness, rod::PerDof());
  modal_ = true;
  modal_ratio_ = damping_ratio;
  changed();
}

void HeldBody::set_springs(const rod::ForkSettings& fork) {
  switch (fork.damping_law) {
    case rod::DampingLaw::per_dof:
      return set_springs(fork.stiffness, fork.damping_ratio);
    case rod::DampingLaw::modal:
      return set_springs_with_modal_damping(fork.stiffness, fork.damping_ratio.stretch);
    case rod::DampingLaw::coefficients:
      return set_springs_and_dampers(fork.stiffness, fork.damping_coefficient);
  }
}

StrainState HeldBody::zero_state() const { return {rod::StrainVector::Zero(size()), rod::StrainVector::Zero(size())}; }

rod::StrainVector HeldBody::stiffness() const {
  rod::StrainVector K(size());
  for (int i = 0; i < size(); ++i) K[i] = K_[active_[static_cast<std::size_t>(i)]];
  return K;
}

rod::StrainMatrix HeldBody::damping() const {
  if (modal_) return D_modal_;
  rod::StrainMatrix D = rod::StrainMatrix::Zero(size(), size());
  for (int i = 0; i < size(); ++i) D(i, i) = D_[active_[static_cast<std::size_t>(i)]];
  return D;
}

StrainState HeldBody::set_dofs(const rod::ForkDofs& dofs, double t, double return_time, const StrainState& full) {
  const auto set_family = [&](const rod::CoordinateRange& range, bool on) {
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

void HeldBody::set_external_wrench(const Wrench& wrench_W) {
  if (wrench_W.force == external_W_.force && wrench_W.moment == external_W_.moment) return;
  external_W_ = wrench_W;
  loaded_ = !(wrench_W.force.isZero(0.0) && wrench_W.moment.isZero(0.0));
  ++load_version_;
}

HandleForcing HeldBody::forcing(const motion::FrameMotion& handle, double t) const {
  const motion::OwnAxesMotion m = handle.in_own_axes(t);
  HandleForcing f;
  f.t = t;
  f.X_WH = m.X;
  f.v_WH_W = m.v_W;
  f.angular_velocity = m.w_B;
  f.angular_acceleration = m.alpha_B;
  f.acceleration_less_gravity.noalias() = m.X.linear().transpose() * (m.a_W + gravity_ * Vector3d::UnitZ());
  return f;
}

void HeldBody::expand(double t, const rod::StrainVector& q, const rod::StrainVector& q_dot, rod::StrainVector& q_all,
                      rod::StrainVector& q_dot_all, rod::StrainVector& q_ddot_all) const {
  q_all.setZero(shape_->size());
  q_dot_all.setZero(shape_->size());
  for (int i = 0; i < q.size(); ++i) {
    q_all[active_[static_cast<std::size_t>(i)]] = q[i];
    q_dot_all[active_[static_cast<std::size_t>(i)]] = q_dot[i];
  }
  if (returning_ > 0) {
    q_ddot_all.setZero(shape_->size());
    prescribe(t, 0, q_all.data(), q_dot_all.data(), q_ddot_all.data());
  }
}

HandleForcings HeldBody::forcing(const motion::FrameMotion& handle, const math::Pack& t) const {
  return {t, handle.forcing(t, gravity_)};
}

HandleForcing HandleForcings::at(int i) const {
  HandleForcing f;
  f.t = math::lane(t, i);
  f.X_WH.linear() = math::matrix(of_H.R_WB, i);
  f.angular_velocity = math::vector(of_H.w_B, i);
  f.angular_acceleration = math::vector(of_H.alpha_B, i);
  f.acceleration_less_gravity = math::vector(of_H.a_B, i);
  return f;
}

void HeldBody::kinematics(double t, const rod::StrainVector& q, const rod::StrainVector& q_dot, Kinematics& k) const {
  rod::StrainVector q_ddot;
  expand(t, q, q_dot, k.q, k.q_dot, q_ddot);
  kinematics(k);
}

void HeldBody::kinematics(Kinematics& k) const {
  shape_->tip(k.q, k.q_dot, k.tip);
  k.r_EO = k.tip.R_HE * p_EO_;
  k.p_HO = k.tip.p_HE + k.r_EO;
  k.R_HO = k.tip.R_HE * R_EO_;
  k.linear.resize(3, shape_->size());
  for (int i = 0; i < shape_->size(); ++i) k.linear.col(i) = k.tip.linear.col(i) + k.tip.angular.col(i).cross(k.r_EO);
}

rod::StrainMatrix HeldBody::mass_matrix(const Kinematics& k, Matrix3d& I_H) const {
  I_H = k.R_HO * body_.inertia_O * k.R_HO.transpose();
  const int n = size();
  rod::StrainMatrix M(n, n);
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

rod::StrainMatrix HeldBody::mass_matrix(double t, const rod::StrainVector& q) const {
  Kinematics k;
  kinematics(t, q, rod::StrainVector::Zero(size()), k);
  Matrix3d I_H;
  return mass_matrix(k, I_H);
}

StrainState HeldBody::full_state(double t, const StrainState& state) const {
  StrainState full{rod::StrainVector::Zero(shape_->size()), rod::StrainVector::Zero(shape_->size())};
  for (int i = 0; i < size(); ++i) {
    full.q[active_[static_cast<std::size_t>(i)]] = state.q[i];
    full.q_dot[active_[static_cast<std::size_t>(i)]] = state.q_dot[i];
  }
  if (returning_ > 0) {
    rod::StrainVector q_ddot = rod::StrainVector::Zero(shape_->size());
    prescribe(t, 0, full.q.data(), full.q_dot.data(), q_ddot.data());
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

Eigen::Matrix<double, 6, Eigen::Dynamic, 0, 6, rod::max_strain_coordinates> HeldBody::object_jacobian(
    double t, const rod::StrainVector& q) const {
  Kinematics k;
  kinematics(t, q, rod::StrainVector::Zero(size()), k);
  Eigen::Matrix<double, 6, Eigen::Dynamic, 0, 6, rod::max_strain_coordinates> J(6, size());
  for (int i = 0; i < size(); ++i) {
    const int c = active_[static_cast<std::size_t>(i)];
    J.col(i) << k.linear.col(c), k.tip.angular.col(c);
  }
  return J;
}

rod::StrainVector HeldBody::project_twist(const HandleForcing& h, const rod::StrainVector& q,
                                          const Twist& V_WO_W) const {
  if (size() == 0) return rod::StrainVector::Zero(0);
  const rod::StrainVector zero = rod::StrainVector::Zero(size());
  const motion::MotionState carried = object(h, {q, zero});
  Kinematics k;
  kinematics(h.t, q, zero, k);
  Matrix3d I_H;
  const rod::StrainMatrix M = mass_matrix(k, I_H);
  const auto R_HW = h.X_WH.linear().transpose();
  const Vector3d momentum = body_.mass * (R_HW * (V_WO_W.linear - carried.velocity.linear));
  const Vector3d angular_momentum = I_H * (R_HW * (V_WO_W.angular - carried.velocity.angular));
  rod::StrainVector p(size());
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

rod::StrainVector HeldBody::elastic_force(double t, const rod::StrainVector& q) const {
  const StrainState full = full_state(t, {q, rod::StrainVector::Zero(size())});
  const rod::StrainVector all = K_.cwiseProduct(full.q);
  rod::StrainVector force(size());
  for (int i = 0; i < size(); ++i) force[i] = all[active_[static_cast<std::size_t>(i)]];
  return force;
}

double HeldBody::kinetic_energy(const Twist& V, const Matrix3d& R_WO) const {
  const Vector3d w_O = R_WO.transpose() * V.angular;
  return 0.5 * body_.mass * V.linear.squaredNorm() + 0.5 * w_O.dot(body_.inertia_O * w_O);
}

}  // namespace spring_workbench::dynamics
