#include "spring_workbench/dynamics/held_body.h"

#include <Eigen/Cholesky>
#include <Eigen/SVD>
#include <algorithm>
#include <cmath>
#include <utility>

namespace spring_workbench::dynamics {
namespace {

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
  // Filled up with zeros to 6 × 6, because Eigen compiles a decomposition of a fixed square much faster: the largest
  // singular values, which come first, are those of the block, and so are their vectors.
  Matrix6d of_modes = Matrix6d::Zero();
  of_modes.topLeftCorner(n, stiff) = M.llt().matrixL().solve(root);
  const Eigen::JacobiSVD<Matrix6d> modes(of_modes, Eigen::ComputeFullV);
  const rod::StrainMatrix V = modes.matrixV().topLeftCorner(stiff, stiff);
  const rod::StrainVector frequencies = modes.singularValues().head(stiff);
  return 2.0 * ratio * root * V * frequencies.cwiseInverse().asDiagonal() * V.transpose() * root.transpose();
}

}  // namespace

HeldBody::HeldBody(std::shared_ptr<const rod::ShapeModel> shape, const BodyInertia& body, double gravity)
    : shape_(std::move(shape)), body_(body), gravity_(gravity), coordinates_(shape_->size()) {
  p_OE_ = body.X_OE.translation();
  p_EO_ = -(body.X_OE.linear().transpose() * p_OE_);
  R_EO_ = body.X_OE.linear().transpose();
  K_ = D_ = rod::StrainVector::Zero(coordinates_.count());
  changed();
}

void HeldBody::changed() {
  ++version_;
  set_modal_damping();
}

void HeldBody::exchange(math::StateArchive& state) {
  state(version_, load_version_, stiffness_, damping_, K_, D_, modal_, modal_ratio_, coordinates_, external_W_, loaded_,
        couplings_);
  if (state.sets()) set_modal_damping();
}

void HeldBody::set_modal_damping() {
  if (!modal_) return;
  const rod::StrainVector zero = rod::StrainVector::Zero(coordinates_.count());
  Matrix3d I_H;
  D_modal_ = modal_damping(mass_matrix(kinematics({zero, zero}), I_H), stiffness(), modal_ratio_);
}

double HeldBody::axial_inertia() const {
  const Vector3d axis = body_.X_OE.linear().col(2);
  return axis.dot(body_.inertia_O * axis) + body_.mass * axis.cross(p_OE_).squaredNorm();
}

rod::PerDof HeldBody::damping_of(const rod::PerDof& stiffness, const rod::PerDof& ratio) const {
  rod::PerDof c;
  c.stretch = 2.0 * ratio.stretch * std::sqrt(body_.mass * stiffness.stretch);
  c.bend = 2.0 * ratio.bend * std::sqrt(body_.mass * stiffness.bend);
  c.torsion = 2.0 * ratio.torsion * std::sqrt(axial_inertia() * stiffness.torsion);
  return c;
}

void HeldBody::set_springs(const rod::PerDof& stiffness, const rod::PerDof& damping_ratio) {
  set_springs_and_dampers(stiffness, damping_of(stiffness, damping_ratio));
}

void HeldBody::set_springs_and_dampers(const rod::PerDof& stiffness, const rod::PerDof& damping) {
  stiffness_ = stiffness;
  damping_ = damping;
  K_ = shape_->stiffness(stiffness);
  D_ = shape_->damping(damping, stiffness);
  modal_ = false;
  changed();
}

void HeldBody::set_springs_with_modal_damping(const rod::PerDof& stiffness, double damping_ratio) {
  set_springs_and_dampers(stiffness, rod::PerDof());
  damping_ = damping_of(stiffness, {damping_ratio, damping_ratio, damping_ratio});
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

rod::StrainVector HeldBody::stiffness() const { return coordinates_.gather(K_); }

rod::StrainMatrix HeldBody::damping() const {
  if (modal_) return D_modal_;
  return rod::StrainMatrix(coordinates_.gather(D_).asDiagonal());
}

void HeldBody::attach(const std::vector<Attached>& couplings) {
  if (couplings_.attach(couplings)) ++version_;
}

HeldBody::Springs HeldBody::springs(const HandleForcing& h, const rod::StrainVector& q) const {
  Springs all{stiffness().asDiagonal(), damping()};
  if (!coupled()) return all;
  const Coupling::Springs more = read_couplings(h, {q, rod::StrainVector::Zero(size())}).springs;
  const auto J = object_jacobian(h.t, q);
  all.K += J.transpose() * more.stiffness * J;
  all.D += J.transpose() * more.damping * J;
  return all;
}

StrainState HeldBody::set_dofs(const rod::ForkDofs& dofs, double t, double return_time, const StrainState& full) {
  coordinates_.set(shape_->bend(), dofs.bend, t, return_time, full);
  coordinates_.set(shape_->torsion(), dofs.torsion, t, return_time, full);
  coordinates_.set(shape_->stretch(), dofs.stretch, t, return_time, full);
  changed();
  return {coordinates_.gather(full.q), coordinates_.gather(full.q_dot)};
}

bool HeldBody::drop_finished_returns(double t) {
  const bool dropped = coordinates_.drop_finished_returns(t);
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
  couplings_.find_relative_motions(handle, t, f.seen);
  return f;
}

HandleForcings HeldBody::forcing(const motion::FrameMotion& handle, const math::Pack& t) const {
  HandleForcings f;
  f.t = t;
  f.of_H = handle.forcing(t, gravity_);
  couplings_.find_relative_motions(handle, t, f.seen);
  return f;
}

HandleForcing HandleForcings::at(int i) const {
  HandleForcing f;
  f.t = math::lane(t, i);
  f.X_WH.linear() = math::matrix(of_H.R_WB, i);
  f.angular_velocity = math::vector(of_H.w_B, i);
  f.angular_acceleration = math::vector(of_H.alpha_B, i);
  f.acceleration_less_gravity = math::vector(of_H.a_B, i);
  f.v_WH_W = f.X_WH.linear() * math::vector(of_H.v_B, i);
  f.seen = Couplings::lane(seen, i);
  return f;
}

HandleForcing HeldBody::with_frames_at_rest(HandleForcing handle) const {
  for (std::size_t i = 0; i < handle.seen.count; ++i) {
    handle.seen.in_frame(i).v_AB = handle.seen.in_frame(i).w_AB = math::none<double>();
  }
  return handle;
}

const rod::TipOf<double>& HeldBody::tip(const double* q, const double* q_dot, bool needs_rates) const {
  const int n = coordinates_.count();
  LastTip& last = last_tip_;
  const bool same = last.known && std::equal(q, q + n, last.q.begin()) &&
                    (!needs_rates || std::equal(q_dot, q_dot + n, last.q_dot.begin()));
  if (same) return last.tip;
  std::copy_n(q, n, last.q.begin());
  std::copy_n(q_dot, n, last.q_dot.begin());
  shape_->tip(q, q_dot, last.tip);
  last.known = true;
  return last.tip;
}

HeldBody::Kinematics HeldBody::kinematics(const StrainState& full) const {
  const rod::TipOf<double>& of_tip = tip(full.q.data(), full.q_dot.data(), false);
  Kinematics k;
  const Matrix3d R_HE = math::matrix(of_tip.R_HE, 0);
  const math::Three<double> r_EO = of_tip.R_HE * math::three(p_EO_);
  k.R_HO = R_HE * R_EO_;
  k.linear.resize(3, full.q.size());
  k.angular.resize(3, full.q.size());
  for (Eigen::Index i = 0; i < full.q.size(); ++i) {
    k.linear.col(i) = math::vector(of_tip.linear[i] + math::cross(of_tip.angular[i], r_EO));
    k.angular.col(i) = math::vector(of_tip.angular[i]);
  }
  return k;
}

HeldBody::Kinematics HeldBody::kinematics(double t, const rod::StrainVector& q) const {
  return kinematics(full_state(t, {q, rod::StrainVector::Zero(size())}));
}

rod::StrainMatrix HeldBody::mass_matrix(const Kinematics& k, Matrix3d& I_H) const {
  I_H = k.R_HO * body_.inertia_O * k.R_HO.transpose();
  const int n = size();
  rod::StrainMatrix M(n, n);
  for (int j = 0; j < n; ++j) {
    const Vector3d momentum = body_.mass * k.linear.col(coordinates_[j]);
    const Vector3d angular_momentum = I_H * k.angular.col(coordinates_[j]);
    for (int i = 0; i <= j; ++i) {
      const int c = coordinates_[i];
      M(i, j) = M(j, i) = k.linear.col(c).dot(momentum) + k.angular.col(c).dot(angular_momentum);
    }
  }
  return M;
}

rod::StrainMatrix HeldBody::mass_matrix(double t, const rod::StrainVector& q) const {
  Matrix3d I_H;
  return mass_matrix(kinematics(t, q), I_H);
}

bool HeldBody::rechart(StrainState& state) const {
  if (returning()) return false;
  StrainState full = full_state(0.0, state);
  if (!shape_->rechart(full.q, full.q_dot)) return false;
  state = {coordinates_.gather(full.q), coordinates_.gather(full.q_dot)};
  return true;
}

Eigen::Matrix<double, 6, Eigen::Dynamic, 0, 6, rod::max_strain_coordinates> HeldBody::object_jacobian(
    double t, const rod::StrainVector& q) const {
  const Kinematics k = kinematics(t, q);
  Eigen::Matrix<double, 6, Eigen::Dynamic, 0, 6, rod::max_strain_coordinates> J(6, size());
  for (int i = 0; i < size(); ++i) J.col(i) << k.linear.col(coordinates_[i]), k.angular.col(coordinates_[i]);
  return J;
}

rod::StrainVector HeldBody::project_twist(const HandleForcing& h, const rod::StrainVector& q,
                                          const Twist& V_WO_W) const {
  if (size() == 0) return rod::StrainVector::Zero(0);
  const motion::MotionState carried = object(h, {q, rod::StrainVector::Zero(size())});
  const Kinematics k = kinematics(h.t, q);
  Matrix3d I_H;
  const rod::StrainMatrix M = mass_matrix(k, I_H);
  const auto R_HW = h.X_WH.linear().transpose();
  const Vector3d momentum = body_.mass * (R_HW * (V_WO_W.linear - carried.velocity.linear));
  const Vector3d angular_momentum = I_H * (R_HW * (V_WO_W.angular - carried.velocity.angular));
  const rod::StrainVector p =
      coordinates_.gather(k.linear.transpose() * momentum + k.angular.transpose() * angular_momentum);
  return M.llt().solve(p);
}

double HeldBody::elastic_energy(double t, const StrainState& state) const {
  const StrainState full = full_state(t, state);
  return 0.5 * full.q.dot(K_.cwiseProduct(full.q));
}

rod::StrainVector HeldBody::elastic_force(double t, const rod::StrainVector& q) const {
  const StrainState full = full_state(t, {q, rod::StrainVector::Zero(size())});
  return coordinates_.gather(K_.cwiseProduct(full.q));
}

double HeldBody::kinetic_energy(const Twist& V, const Matrix3d& R_WO) const {
  const Vector3d w_O = R_WO.transpose() * V.angular;
  return 0.5 * body_.mass * V.linear.squaredNorm() + 0.5 * w_O.dot(body_.inertia_O * w_O);
}

}  // namespace spring_workbench::dynamics
