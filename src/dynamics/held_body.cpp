#include "spring_workbench/dynamics/held_body.h"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <Eigen/SVD>
#include <cmath>
#include <type_traits>
#include <utility>

#include "spring_workbench/math/positive_definite.h"
#include "spring_workbench/math/so3.h"

namespace spring_workbench {
namespace {

/// After this many time constants a critically damped return is over: exp(−45) is below the rounding of its start.
constexpr double return_is_over = 45.0;

/// `2 ζ M^½ (M^-½ K M^-½)^½ M^½` for a diagonal `K`: of the stiff coordinates 2 ζ K^½ (K^½ M⁻¹ K^½)^-½ K^½, from the singular
/// values of L⁻¹ K^½ with M = L Lᵀ. So soft coordinates keep their digits beside stiff ones; without stiffness no damping.
StrainMatrix modal_damping(const StrainMatrix& M, const StrainVector& K, double ratio) {
  const Eigen::Index n = K.size();
  StrainMatrix root = StrainMatrix::Zero(n, n);  // its first `stiff` columns
  Eigen::Index stiff = 0;
  for (Eigen::Index i = 0; i < n; ++i) {
    if (K[i] > 0.0) root(i, stiff++) = std::sqrt(K[i]);
  }
  if (stiff == 0) return root;
  root.conservativeResize(n, stiff);
  const StrainMatrix of_modes = M.llt().matrixL().solve(root);
  const Eigen::JacobiSVD<StrainMatrix> modes(of_modes, Eigen::ComputeFullV);
  return 2.0 * ratio * root * modes.matrixV() * modes.singularValues().cwiseInverse().asDiagonal() *
         modes.matrixV().transpose() * root.transpose();
}

}  // namespace

HeldBody::HeldBody(std::shared_ptr<const ShapeModel> shape, const BodyInertia& body, double gravity)
    : shape_(std::move(shape)), body_(body), gravity_(gravity) {
  p_OE_ = body.X_OE.translation();
  p_EO_ = -(body.X_OE.linear().transpose() * p_OE_);
  R_EO_ = body.X_OE.linear().transpose();
  inertia_E_ = R_EO_ * body.inertia_O * R_EO_.transpose();
  inverse_inertia_O_ = body.inertia_O.inverse();
  shape_size_ = shape_->size();
  K_ = D_ = StrainVector::Zero(shape_size_);
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
  if (active_count_ == 1) {
    const StrainVector one = StrainVector::Ones(shape_size_);
    axial_unit_ = active_[0] == shape_->stretch().begin ? shape_->extension(one) : shape_->twist(one);
  }
  if (!modal_) return;
  Kinematics unstrained;
  unstrained.q = unstrained.q_dot = StrainVector::Zero(shape_size_);
  kinematics(unstrained);
  Matrix3d I_H;
  D_modal_ = modal_damping(mass_matrix(unstrained, I_H), stiffness(), modal_ratio_);
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
  if (auto shape = shape_->for_stiffness(stiffness)) shape_ = std::move(shape);
  K_ = shape_->stiffness(stiffness);
  D_ = shape_->stiffness(damping);  // (c_f / k_f) K_f, without dividing by k_f
  modal_ = false;
  changed();
}

void HeldBody::set_springs_with_modal_damping(const PerFamily& stiffness, double damping_ratio) {
  set_springs_and_dampers(stiffness, PerFamily());
  modal_ = true;
  modal_ratio_ = damping_ratio;
  changed();
}

void HeldBody::set_springs(const ForkSettings& fork) {
  if (fork.damping_law == "modal") {
    set_springs_with_modal_damping(fork.stiffness, fork.damping_ratio.stretch);
  } else {
    set_springs(fork.stiffness, fork.damping_ratio);
  }
}

StrainState HeldBody::zero_state() const { return {StrainVector::Zero(size()), StrainVector::Zero(size())}; }

StrainVector HeldBody::stiffness() const {
  StrainVector K(size());
  for (int i = 0; i < size(); ++i) K[i] = K_[active_[static_cast<std::size_t>(i)]];
  return K;
}

StrainMatrix HeldBody::damping() const {
  if (modal_) return D_modal_;
  StrainMatrix D = StrainMatrix::Zero(size(), size());
  for (int i = 0; i < size(); ++i) D(i, i) = D_[active_[static_cast<std::size_t>(i)]];
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

template <typename S>
void HeldBody::prescribe(double t, int k, S* q, S* q_dot, S* q_ddot) const {
  for (int i = 0; i < shape_size_; ++i) {
    const auto c = static_cast<std::size_t>(i);
    if (mode_[c] != Mode::returning) continue;
    // (B + A τ) e^{−τ/T}: the paper's critically damped closed form (section 3.3).
    const Return& r = return_[c];
    const double rate = 1.0 / r.time_constant;
    const double tau = t - r.t0;
    const double decay = std::exp(-rate * tau);
    const double A = r.rate0 + rate * r.q0;
    const double x = (r.q0 + A * tau) * decay, v = A * decay - rate * x;
    set_lane(q[i], k, x);
    set_lane(q_dot[i], k, v);
    set_lane(q_ddot[i], k, -rate * A * decay - rate * v);
  }
}

void HeldBody::set_external_wrench(const Wrench& wrench_W) {
  if (wrench_W.force == external_W_.force && wrench_W.moment == external_W_.moment) return;
  external_W_ = wrench_W;
  loaded_ = !(wrench_W.force.isZero(0.0) && wrench_W.moment.isZero(0.0));
  ++load_version_;
}

HandleForcing HeldBody::forcing(const FrameMotion& handle, double t) const {
  const OwnAxesMotion m = handle.in_own_axes(t);
  HandleForcing f;
  f.t = t;
  f.X_WH = m.X;
  f.v_WH_W = m.v_W;
  f.angular_velocity = m.w_B;
  f.angular_acceleration = m.alpha_B;
  f.acceleration_less_gravity.noalias() = m.X.linear().transpose() * (m.a_W + gravity_ * Vector3d::UnitZ());
  return f;
}

void HeldBody::expand(double t, const StrainVector& q, const StrainVector& q_dot, StrainVector& q_all,
                      StrainVector& q_dot_all, StrainVector& q_ddot_all) const {
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

HandleForcings HeldBody::forcing(const FrameMotion& handle, const Pack& t) const {
  return {t, handle.forcing(t, gravity_)};
}

HandleForcing HandleForcings::at(int i) const {
  HandleForcing f;
  f.t = lane(t, i);
  f.X_WH.linear() = matrix(of_H.R_WB, i);
  f.angular_velocity = vector(of_H.w_B, i);
  f.angular_acceleration = vector(of_H.alpha_B, i);
  f.acceleration_less_gravity = vector(of_H.a_B, i);
  return f;
}

void HeldBody::kinematics(double t, const StrainVector& q, const StrainVector& q_dot, Kinematics& k) const {
  StrainVector q_ddot;
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

template <typename S>
struct HeldBody::Rigid {
  Three<S> r_EO;      ///< from tip to centre of mass, axes of H
  ThreeByThree<S> R_HO;
  Three<S> force;     ///< mass times acceleration of O, less gravity and contact, axes of H
  Three<S> moment_O;  ///< rate of the angular momentum about O, less the contact's moment, axes of O
};

namespace {

/// What `size` rates (or accelerations) of the strain add to the tip's angular and linear one.
template <typename S>
SPRING_WORKBENCH_INLINE void add_tip_motion(const TipOf<S>& tip, int size, const S* rate, Three<S>& angular,
                                            Three<S>& linear) {
  if (tip.separate) {
    angular += rate[2] * tip.angular[2] + rate[3] * tip.angular[3] + rate[4] * tip.angular[4];
    linear += Three<S>{rate[0], rate[1], rate[5]};
    return;
  }
  for (int i = 0; i < size; ++i) {
    angular += rate[i] * tip.angular[i];
    linear += rate[i] * tip.linear[i];
  }
}

}  // namespace

template <typename S>
SPRING_WORKBENCH_INLINE HeldBody::Rigid<S> HeldBody::without_strain_acceleration(const FrameForcing<S>& h,
                                                                                 const TipOf<S>& tip, const S* q_dot,
                                                                                 const S* q_ddot) const {
  Rigid<S> r;
  r.r_EO = tip.R_HE * three(p_EO_);
  r.R_HO = tip.R_HE * three_by_three(R_EO_);
  const Three<S> p_HO = tip.p_HE + r.r_EO;
  Three<S> w_rel = none<S>(), v_E = none<S>();  // of the tip, in the turning frame H
  Three<S> alpha_rel = tip.angular_bias, a_E = tip.linear_bias;
  add_tip_motion(tip, shape_size_, q_dot, w_rel, v_E);
  if (returning_ > 0) add_tip_motion(tip, shape_size_, q_ddot, alpha_rel, a_E);
  const Three<S> v_rel = v_E + cross(w_rel, r.r_EO);
  const Three<S>& w_H = h.w_B;
  const Three<S> a = h.a_B + a_E + cross(h.alpha_B, p_HO) + cross(w_H, cross(w_H, p_HO) + 2.0 * v_rel) +
                     cross(alpha_rel, r.r_EO) + cross(w_rel, cross(w_rel, r.r_EO));
  const Three<S> alpha_O = transposed(r.R_HO, h.alpha_B + cross(w_H, w_rel) + alpha_rel);
  const Three<S> w_O = transposed(r.R_HO, w_H + w_rel);
  const ThreeByThree<double> I = three_by_three(body_.inertia_O);
  r.force = body_.mass * a;
  r.moment_O = I * alpha_O + cross(w_O, I * w_O);
  if (loaded_) {
    r.force = r.force - transposed(h.R_WB, three(external_W_.force));
    r.moment_O = r.moment_O - transposed(r.R_HO, transposed(h.R_WB, three(external_W_.moment)));
  }
  return r;
}

/// The body slides along the fork's axis: Newton's law along it.
template <typename S>
SPRING_WORKBENCH_INLINE S HeldBody::slide(const FrameForcing<S>& h, const S& extension, S force) const {
  const S zero{};
  const Three<S> p_HO{zero + p_EO_.x(), zero + p_EO_.y(), extension + (shape_->length() + p_EO_.z())};
  if (loaded_) force += transposed(h.R_WB, three(external_W_.force)).z;
  const S a_z = h.a_B.z + h.alpha_B.x * p_HO.y - h.alpha_B.y * p_HO.x + h.w_B.z * dot(h.w_B, p_HO) -
                p_HO.z * dot(h.w_B, h.w_B);
  return force * (1.0 / body_.mass) - a_z;
}

/// The body turns about the fork's axis: Euler's law about it, in the axes of the tip E, where the body is at rest.
template <typename S>
SPRING_WORKBENCH_INLINE S HeldBody::turn(const FrameForcing<S>& h, const S& twist, const S& rate, S moment) const {
  const So3CoefficientsOf<S> k = so3_coefficients(S(twist * twist));
  const S sine = twist * k.a, cosine = 1.0 - twist * twist * k.b;
  const auto to_E = [&](const Three<S>& v) {
    return Three<S>{cosine * v.x + sine * v.y, cosine * v.y - sine * v.x, v.z};
  };
  const Three<double> p_HO{p_EO_.x(), p_EO_.y(), p_EO_.z() + shape_->length()};
  const Three<double> by_turn{-p_EO_.y(), p_EO_.x(), 0.0};  // velocity of O for the turn's rate 1
  const ThreeByThree<double> I = three_by_three(inertia_E_);
  const Three<S> w_H = to_E(h.w_B), alpha_H = to_E(h.alpha_B);
  const Three<S> w{w_H.x, w_H.y, w_H.z + rate};
  const Three<S> alpha{alpha_H.x + rate * w_H.y, alpha_H.y - rate * w_H.x, alpha_H.z};
  const Three<S> a = to_E(h.a_B) + cross(alpha_H, p_HO) + cross(w_H, cross(w_H, p_HO) + (2.0 * rate) * by_turn);
  const Three<S> Iw = I * w;
  if (loaded_) {
    moment += dot(to_E(transposed(h.R_WB, three(external_W_.force))), by_turn) +
              transposed(h.R_WB, three(external_W_.moment)).z;
  }
  moment -= body_.mass * dot(a, by_turn) + (I * alpha).z + w.x * Iw.y - w.y * Iw.x;
  return moment * (1.0 / (I.z.z + body_.mass * dot(by_turn, by_turn)));
}

template <int n, typename S>
SPRING_WORKBENCH_INLINE void HeldBody::accelerate(const S& t, const FrameForcing<S>& h, const S* q, const S* q_dot,
                                                  S* q_ddot) const {
  S q_all[max_strain_coordinates]{}, q_dot_all[max_strain_coordinates]{}, q_ddot_all[max_strain_coordinates];
  S springs[n];
  for (int i = 0; i < n; ++i) {
    const int c = active_[static_cast<std::size_t>(i)];
    q_all[c] = q[i];
    q_dot_all[c] = q_dot[i];
    springs[i] = -K_[c] * q[i] - D_[c] * q_dot[i];
  }
  if (modal_) {
    for (int j = 0; j < n; ++j) {
      for (int i = 0; i < n; ++i) springs[i] -= D_modal_(i, j) * q_dot[j];
    }
  }
  if constexpr (n == 1) {
    if (returning_ == 0) {
      const bool stretch = active_[0] == shape_->stretch().begin;
      const double per_unit = 1.0 / axial_unit_;
      const S x = axial_unit_ * q[0], force = per_unit * springs[0];
      q_ddot[0] = per_unit * (stretch ? slide(h, x, force) : turn(h, x, S(axial_unit_ * q_dot[0]), force));
      return;
    }
  }
  if (returning_ > 0) {
    for (S& x : q_ddot_all) x = S{};
    for (int k = 0; k < lanes<S>; ++k) prescribe(lane(t, k), k, q_all, q_dot_all, q_ddot_all);
  }
  TipOf<S> tip;
  shape_->tip(q_all, q_dot_all, tip);
  if (tip.condensed) {
    for (int i = 0; i < n; ++i) springs[i] -= tip.condensed_force[active_[static_cast<std::size_t>(i)]];
  }
  const Rigid<S> rigid = without_strain_acceleration(h, tip, q_dot_all, q_ddot_all);

  if constexpr (n == 6) {
    if (tip.separate) {
      // Newton and Euler for the body under the tip's wrench, then back to the coordinates: no mass matrix.
      const Three<S> force{springs[0], springs[1], springs[5]};
      const Three<S> moment_E = transposed(tip.inverse_angular, Three<S>{springs[2], springs[3], springs[4]});
      const Three<S> a_O = (1.0 / body_.mass) * (force - rigid.force);
      const Three<S> moment_O = transposed(rigid.R_HO, moment_E - cross(rigid.r_EO, force)) - rigid.moment_O;
      const Three<S> alpha = rigid.R_HO * (three_by_three(inverse_inertia_O_) * moment_O);
      const Three<S> a_E = a_O - cross(alpha, rigid.r_EO);
      const Three<S> turn = tip.inverse_angular * alpha;
      q_ddot[0] = a_E.x;
      q_ddot[1] = a_E.y;
      q_ddot[2] = turn.x;
      q_ddot[3] = turn.y;
      q_ddot[4] = turn.z;
      q_ddot[5] = a_E.z;
      return;
    }
  }
  Three<S> linear[n], angular[n], momentum[n];  // of O: axes of H and of O
  const ThreeByThree<double> I = three_by_three(body_.inertia_O);
  for (int i = 0; i < n; ++i) {
    const int c = active_[static_cast<std::size_t>(i)];
    linear[i] = tip.linear[c] + cross(tip.angular[c], rigid.r_EO);
    angular[i] = transposed(rigid.R_HO, tip.angular[c]);
    momentum[i] = I * angular[i];
  }
  S M[n * n];
  for (int j = 0; j < n; ++j) {
    for (int i = j; i < n; ++i) M[i * n + j] = body_.mass * dot(linear[i], linear[j]) + dot(angular[i], momentum[j]);
    q_ddot[j] = springs[j] - dot(linear[j], rigid.force) - dot(angular[j], rigid.moment_O);
  }
  solve_positive_definite<n>(M, q_ddot);
}

template <int n>
Eigen::Matrix<double, n, 1> HeldBody::acceleration(const HandleForcing& h, const Eigen::Matrix<double, n, 1>& q,
                                                   const Eigen::Matrix<double, n, 1>& q_dot) const {
  const FrameForcing<double> forcing{three_by_three(h.X_WH.linear()), three(h.angular_velocity),
                                     three(h.angular_acceleration), three(h.acceleration_less_gravity)};
  Eigen::Matrix<double, n, 1> q_ddot;
  accelerate<n>(h.t, forcing, q.data(), q_dot.data(), q_ddot.data());
  return q_ddot;
}

template <int n>
SPRING_WORKBENCH_WIDE void HeldBody::acceleration(const HandleForcings& h, const Pack* q, const Pack* q_dot, Pack* q_ddot) const {
  accelerate<n>(h.t, h.of_H, q, q_dot, q_ddot);
}

template Eigen::Matrix<double, 1, 1> HeldBody::acceleration<1>(const HandleForcing&, const Eigen::Matrix<double, 1, 1>&,
                                                               const Eigen::Matrix<double, 1, 1>&) const;
template void HeldBody::acceleration<1>(const HandleForcings&, const Pack*, const Pack*, Pack*) const;
template Eigen::Matrix<double, 2, 1> HeldBody::acceleration<2>(const HandleForcing&, const Eigen::Matrix<double, 2, 1>&,
                                                               const Eigen::Matrix<double, 2, 1>&) const;
template void HeldBody::acceleration<2>(const HandleForcings&, const Pack*, const Pack*, Pack*) const;
template Eigen::Matrix<double, 3, 1> HeldBody::acceleration<3>(const HandleForcing&, const Eigen::Matrix<double, 3, 1>&,
                                                               const Eigen::Matrix<double, 3, 1>&) const;
template void HeldBody::acceleration<3>(const HandleForcings&, const Pack*, const Pack*, Pack*) const;
template Eigen::Matrix<double, 4, 1> HeldBody::acceleration<4>(const HandleForcing&, const Eigen::Matrix<double, 4, 1>&,
                                                               const Eigen::Matrix<double, 4, 1>&) const;
template void HeldBody::acceleration<4>(const HandleForcings&, const Pack*, const Pack*, Pack*) const;
template Eigen::Matrix<double, 5, 1> HeldBody::acceleration<5>(const HandleForcing&, const Eigen::Matrix<double, 5, 1>&,
                                                               const Eigen::Matrix<double, 5, 1>&) const;
template void HeldBody::acceleration<5>(const HandleForcings&, const Pack*, const Pack*, Pack*) const;
template Eigen::Matrix<double, 6, 1> HeldBody::acceleration<6>(const HandleForcing&, const Eigen::Matrix<double, 6, 1>&,
                                                               const Eigen::Matrix<double, 6, 1>&) const;
template void HeldBody::acceleration<6>(const HandleForcings&, const Pack*, const Pack*, Pack*) const;

StrainVector HeldBody::acceleration(const HandleForcing& h, const StrainVector& q, const StrainVector& q_dot) const {
  const auto of = [&](auto size) -> StrainVector {
    constexpr int n = decltype(size)::value;
    return acceleration<n>(h, Eigen::Matrix<double, n, 1>(q), Eigen::Matrix<double, n, 1>(q_dot));
  };
  switch (size()) {
    case 1: return of(std::integral_constant<int, 1>());
    case 2: return of(std::integral_constant<int, 2>());
    case 3: return of(std::integral_constant<int, 3>());
    case 4: return of(std::integral_constant<int, 4>());
    case 5: return of(std::integral_constant<int, 5>());
    case 6: return of(std::integral_constant<int, 6>());
    default: return StrainVector::Zero(0);
  }
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

MotionState HeldBody::object(const HandleForcing& h, const StrainState& state, const StrainVector* q_ddot) const {
  double q[max_strain_coordinates]{}, rate[max_strain_coordinates]{}, acceleration[max_strain_coordinates]{};
  for (int i = 0; i < size(); ++i) {
    const int c = active_[static_cast<std::size_t>(i)];
    q[c] = state.q[i];
    rate[c] = state.q_dot[i];
    if (q_ddot != nullptr) acceleration[c] = (*q_ddot)[i];
  }
  if (returning_ > 0) prescribe(h.t, 0, q, rate, acceleration);
  TipOf<double> tip;
  shape_->tip(q, rate, tip);
  // Of the tip, in the turning frame H.
  Three<double> w = none<double>(), v = w, alpha = tip.angular_bias, a = tip.linear_bias;
  add_tip_motion(tip, shape_size_, rate, w, v);
  if (q_ddot != nullptr) add_tip_motion(tip, shape_size_, acceleration, alpha, a);
  const Three<double> r_EO = tip.R_HE * three(p_EO_), p_HO = tip.p_HE + r_EO, v_rel = v + cross(w, r_EO);
  const Three<double> w_H = three(h.angular_velocity), alpha_H = three(h.angular_acceleration);
  const ThreeByThree<double> R_WH = three_by_three(h.X_WH.linear());
  MotionState s;
  s.X.linear() = matrix(R_WH * (tip.R_HE * three_by_three(R_EO_)), 0);
  s.X.translation() = h.X_WH.translation() + vector(R_WH * p_HO);
  s.velocity.linear = h.v_WH_W + vector(R_WH * (cross(w_H, p_HO) + v_rel));
  s.velocity.angular = vector(R_WH * (w_H + w));
  if (q_ddot != nullptr) {
    const Three<double> of_O = a + cross(alpha, r_EO) + cross(w, cross(w, r_EO));
    const Three<double> a_H = three(h.acceleration_less_gravity) + of_O + cross(alpha_H, p_HO) +
                              cross(w_H, cross(w_H, p_HO) + 2.0 * v_rel);
    s.acceleration.linear = vector(R_WH * a_H) - gravity_ * Vector3d::UnitZ();
    s.acceleration.angular = vector(R_WH * (alpha_H + cross(w_H, w) + alpha));
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
  return 0.5 * full.q.dot(K_.cwiseProduct(full.q)) + shape_->condensed_energy(full.q);
}

StrainVector HeldBody::elastic_force(double t, const StrainVector& q) const {
  const StrainState full = full_state(t, {q, StrainVector::Zero(size())});
  TipKinematics tip;
  shape_->tip(full.q, full.q_dot, tip);
  StrainVector all = K_.cwiseProduct(full.q);
  if (tip.condensed_force.size() > 0) all += tip.condensed_force;
  StrainVector force(size());
  for (int i = 0; i < size(); ++i) force[i] = all[active_[static_cast<std::size_t>(i)]];
  return force;
}

double HeldBody::kinetic_energy(const Twist& V, const Matrix3d& R_WO) const {
  const Vector3d w_O = R_WO.transpose() * V.angular;
  return 0.5 * body_.mass * V.linear.squaredNorm() + 0.5 * w_O.dot(body_.inertia_O * w_O);
}

}  // namespace spring_workbench
