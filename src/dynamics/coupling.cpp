#include "spring_workbench/dynamics/coupling.h"

#include <algorithm>

namespace spring_workbench::dynamics {
namespace {

RelativeMotion<double> seen_from(const motion::OwnAxesMotion& A, const motion::OwnAxesMotion& H) {
  const auto R_AW = A.X.linear().transpose();
  const Matrix3d R_AH = R_AW * H.X.linear();
  const Vector3d p = R_AW * (H.X.translation() - A.X.translation());
  return {math::three_by_three(R_AH), math::three(p), math::three(Vector3d(R_AW * (H.v_W - A.v_W) - A.w_B.cross(p))),
          math::three(Vector3d(R_AH * H.w_B - A.w_B))};
}

/// B in A and C in B: C in A.
template <typename S>
RelativeMotion<S> operator*(const RelativeMotion<S>& A_B, const RelativeMotion<S>& B_C) {
  const math::Three<S> r = A_B.R_AB * B_C.p_AB;
  return {A_B.R_AB * B_C.R_AB, A_B.p_AB + r, A_B.v_AB + cross(A_B.w_AB, r) + A_B.R_AB * B_C.v_AB,
          A_B.w_AB + A_B.R_AB * B_C.w_AB};
}

}  // namespace

RelativeMotion<double> seen_from(const motion::OwnAxesMotion& A, const motion::MotionState& O) {
  motion::OwnAxesMotion own;
  own.X = O.X;
  own.v_W = O.velocity.linear;
  own.w_B = O.X.linear().transpose() * O.velocity.angular;
  return seen_from(A, own);
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

void Couplings::look(const motion::FrameMotion& handle, double t, Seen<double>& seen) const {
  seen.resize(attached_.size());
  for (std::size_t i = 0; i < seen.count; ++i) {
    const Attached& a = attached_[i];
    const motion::OwnAxesMotion A = a.frame->in_own_axes(t);
    const motion::OwnAxesMotion H = (a.handle != nullptr ? *a.handle : handle).in_own_axes(t);
    seen.from(i) = seen_from(A, H);
    seen.distance = std::max({seen.distance, A.X.translation().norm(), H.X.translation().norm()});
  }
}

void Couplings::look(const motion::FrameMotion& handle, const math::Pack& t, Seen<math::Pack>& seen) const {
  seen.resize(attached_.size());
  for (const Attached& a : attached_) a.coupling->begin_step();
  Seen<double> at;
  for (int lane = 0; lane < math::pack_size && seen.count > 0; ++lane) {
    look(handle, t[lane], at);
    seen.distance = std::max(seen.distance, at.distance);
    for (std::size_t i = 0; i < seen.count; ++i) {
      RelativeMotion<math::Pack>& s = seen.from(i);
      math::set_lane(s.R_AB, lane, at.from(i).R_AB);
      math::set_lane(s.p_AB, lane, at.from(i).p_AB);
      math::set_lane(s.v_AB, lane, at.from(i).v_AB);
      math::set_lane(s.w_AB, lane, at.from(i).w_AB);
    }
  }
}

Couplings::Seen<double> Couplings::lane(const Seen<math::Pack>& seen, int i) {
  Seen<double> at;
  at.distance = seen.distance;
  at.resize(seen.count);
  const auto three = [i](const math::Three<math::Pack>& v) { return math::three(math::vector(v, i)); };
  for (std::size_t k = 0; k < seen.count; ++k) {
    const RelativeMotion<math::Pack>& s = seen.from(k);
    at.from(k) = {{three(s.R_AB.x), three(s.R_AB.y), three(s.R_AB.z)}, three(s.p_AB), three(s.v_AB), three(s.w_AB)};
  }
  return at;
}

template <typename S>
Pull<S> Couplings::pull(const S& t, const Seen<S>& seen, const RelativeMotion<S>& H_O) const {
  Pull<S> sum{};
  for (std::size_t i = 0; i < attached_.size(); ++i) {
    Pull<S> of_A;
    attached_[i].coupling->pull(t, seen.from(i) * H_O, of_A);
    sum.force += math::transposed(seen.from(i).R_AB, of_A.force);
    sum.moment += math::transposed(seen.from(i).R_AB, of_A.moment);
  }
  return sum;
}

template Pull<double> Couplings::pull(const double&, const Seen<double>&, const RelativeMotion<double>&) const;
template Pull<math::Pack> Couplings::pull(const math::Pack&, const Seen<math::Pack>&,
                                          const RelativeMotion<math::Pack>&) const;

Couplings::Reading Couplings::read(double t, const Seen<double>& seen, const RelativeMotion<double>& H_O,
                                   const RelativeMotion<double>& W_H) const {
  Reading all;
  const Pull<double> sum = pull(t, seen, H_O);
  all.pull_W = {math::vector(W_H.R_AB * sum.force), math::vector(W_H.R_AB * sum.moment)};
  for (std::size_t i = 0; i < attached_.size(); ++i) {
    const RelativeMotion<double> A_O = seen.from(i) * H_O;
    const Coupling::Springs of_A = attached_[i].coupling->springs(t, A_O);
    Matrix6d to_A = Matrix6d::Zero();
    to_A.topLeftCorner<3, 3>() = to_A.bottomRightCorner<3, 3>() = math::matrix(seen.from(i).R_AB, 0);
    all.springs.stiffness += to_A.transpose() * of_A.stiffness * to_A;
    all.springs.damping += to_A.transpose() * of_A.damping * to_A;
    all.springs.energy += of_A.energy;
    all.springs.dissipated += of_A.dissipated;
    // A's own motion, from the handle's, and what its pull on the object asks of it.
    const math::Three<double> w_WA = seen.from(i).R_AB * W_H.w_AB - seen.from(i).w_AB;
    const math::Three<double> v_WA = seen.from(i).R_AB * W_H.v_AB - seen.from(i).v_AB - cross(w_WA, seen.from(i).p_AB);
    Pull<double> pull;
    attached_[i].coupling->pull(t, A_O, pull);
    all.power += dot(pull.force, v_WA) + dot(pull.moment + cross(A_O.p_AB, pull.force), w_WA) - of_A.dissipated;
  }
  return all;
}

}  // namespace spring_workbench::dynamics
