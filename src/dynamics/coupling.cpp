#include "spring_workbench/dynamics/coupling.h"

#include <algorithm>

namespace spring_workbench::dynamics {
namespace {

RelativeMotion<double> relative_motion(const motion::BodyRateState& A, const motion::BodyRateState& H) {
  const auto R_AW = A.X.linear().transpose();
  const Matrix3d R_AH = R_AW * H.X.linear();
  const Vector3d p = R_AW * (H.X.translation() - A.X.translation());
  return {math::mat3x3(R_AH), math::vec3(p), math::vec3(Vector3d(R_AW * (H.v_W - A.v_W) - A.w_B.cross(p))),
          math::vec3(Vector3d(R_AH * H.w_B - A.w_B))};
}

/// B in A and C in B: C in A.
template <typename S>
RelativeMotion<S> operator*(const RelativeMotion<S>& A_B, const RelativeMotion<S>& B_C) {
  const math::Vec3<S> r = A_B.R_AB * B_C.p_AB;
  return {A_B.R_AB * B_C.R_AB, A_B.p_AB + r, A_B.v_AB + cross(A_B.w_AB, r) + A_B.R_AB * B_C.v_AB,
          A_B.w_AB + A_B.R_AB * B_C.w_AB};
}

}  // namespace

RelativeMotion<double> relative_motion(const motion::BodyRateState& A, const motion::MotionState& O) {
  motion::BodyRateState own;
  own.X = O.X;
  own.v_W = O.velocity.linear;
  own.w_B = O.X.linear().transpose() * O.velocity.angular;
  return relative_motion(A, own);
}

bool Couplings::attach(const std::vector<Attached>& couplings) {
  attached_ = couplings;
  const bool same = std::equal(attached_.begin(), attached_.end(), keys_.begin(), keys_.end(),
                               [](const Attached& a, const Coupling::Key& key) { return a.coupling->key() == key; });
  keys_.resize(attached_.size());
  std::transform(attached_.begin(), attached_.end(), keys_.begin(),
                 [](const Attached& a) { return a.coupling->key(); });
  return !same;
}

void Couplings::find_relative_motions(const motion::Trajectory& handle, double t, RelativeMotions<double>& A_H) const {
  A_H.resize(attached_.size());
  for (std::size_t i = 0; i < A_H.count; ++i) {
    const Attached& a = attached_[i];
    const motion::BodyRateState A = a.frame->body_rate_state(t);
    const motion::BodyRateState H = (a.handle != nullptr ? *a.handle : handle).body_rate_state(t);
    A_H.in_frame(i) = relative_motion(A, H);
    A_H.distance = std::max({A_H.distance, A.X.translation().norm(), H.X.translation().norm()});
  }
}

void Couplings::find_relative_motions(const motion::Trajectory& handle, const math::Pack& t,
                                      RelativeMotions<math::Pack>& A_H) const {
  A_H.resize(attached_.size());
  for (const Attached& a : attached_) a.coupling->begin_step();
  RelativeMotions<double> at;
  for (int lane = 0; lane < math::pack_size && A_H.count > 0; ++lane) {
    find_relative_motions(handle, t[lane], at);
    A_H.distance = std::max(A_H.distance, at.distance);
    for (std::size_t i = 0; i < A_H.count; ++i) {
      RelativeMotion<math::Pack>& s = A_H.in_frame(i);
      math::set_lane(s.R_AB, lane, at.in_frame(i).R_AB);
      math::set_lane(s.p_AB, lane, at.in_frame(i).p_AB);
      math::set_lane(s.v_AB, lane, at.in_frame(i).v_AB);
      math::set_lane(s.w_AB, lane, at.in_frame(i).w_AB);
    }
  }
}

Couplings::RelativeMotions<double> Couplings::lane(const RelativeMotions<math::Pack>& A_H, int i) {
  RelativeMotions<double> at;
  at.distance = A_H.distance;
  at.resize(A_H.count);
  const auto one = [i](const math::Vec3<math::Pack>& v) { return math::vec3(math::vector(v, i)); };
  for (std::size_t k = 0; k < A_H.count; ++k) {
    const RelativeMotion<math::Pack>& s = A_H.in_frame(k);
    at.in_frame(k) = {{one(s.R_AB.x), one(s.R_AB.y), one(s.R_AB.z)}, one(s.p_AB), one(s.v_AB), one(s.w_AB)};
  }
  return at;
}

template <typename S>
Pull<S> Couplings::pull(const S& t, const RelativeMotions<S>& A_H, const RelativeMotion<S>& H_O) const {
  Pull<S> sum{};
  for (std::size_t i = 0; i < attached_.size(); ++i) {
    Pull<S> of_A{};
    attached_[i].coupling->pull(t, A_H.in_frame(i) * H_O, of_A);
    sum.force += math::transposed(A_H.in_frame(i).R_AB, of_A.force);
    sum.moment += math::transposed(A_H.in_frame(i).R_AB, of_A.moment);
  }
  return sum;
}

template Pull<double> Couplings::pull(const double&, const RelativeMotions<double>&,
                                      const RelativeMotion<double>&) const;
template Pull<math::Pack> Couplings::pull(const math::Pack&, const RelativeMotions<math::Pack>&,
                                          const RelativeMotion<math::Pack>&) const;

Couplings::Reading Couplings::read(double t, const RelativeMotions<double>& A_H, const RelativeMotion<double>& H_O,
                                   const RelativeMotion<double>& W_H) const {
  Reading all;
  const Pull<double> sum = pull(t, A_H, H_O);
  all.pull_W = {math::vector(W_H.R_AB * sum.force), math::vector(W_H.R_AB * sum.moment)};
  for (std::size_t i = 0; i < attached_.size(); ++i) {
    const RelativeMotion<double> A_O = A_H.in_frame(i) * H_O;
    const Coupling::Springs of_A = attached_[i].coupling->springs(t, A_O);
    Matrix6d to_A = Matrix6d::Zero();
    to_A.topLeftCorner<3, 3>() = to_A.bottomRightCorner<3, 3>() = math::matrix(A_H.in_frame(i).R_AB, 0);
    all.springs.stiffness += to_A.transpose() * of_A.stiffness * to_A;
    all.springs.damping += to_A.transpose() * of_A.damping * to_A;
    all.springs.energy += of_A.energy;
    all.springs.dissipated_power += of_A.dissipated_power;
    // A's own motion, from the handle's, and what its pull on the object asks of it.
    const math::Vec3<double> w_WA = A_H.in_frame(i).R_AB * W_H.w_AB - A_H.in_frame(i).w_AB;
    const math::Vec3<double> v_WA =
        A_H.in_frame(i).R_AB * W_H.v_AB - A_H.in_frame(i).v_AB - cross(w_WA, A_H.in_frame(i).p_AB);
    Pull<double> pull{};
    attached_[i].coupling->pull(t, A_O, pull);
    all.power += dot(pull.force, v_WA) + dot(pull.moment + cross(A_O.p_AB, pull.force), w_WA) - of_A.dissipated_power;
  }
  return all;
}

}  // namespace spring_workbench::dynamics
