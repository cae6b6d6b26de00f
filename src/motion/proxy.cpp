#include "spring_workbench/motion/proxy.h"

#include "constants.h"
#include "spring_workbench/math/moving_frames.h"
#include "spring_workbench/math/so3.h"

namespace spring_workbench::motion {
namespace {

Twist sum(const Twist& a, const Twist& b) { return to_twist(to_vector(a) + to_vector(b)); }

/// Pose and velocity, with body rates, of the proxy of a hand.
struct ProxyMotion {
  ProxyMotion(const MotionState& hand, const RigidTransform& offset, const Twist& rate)
      : X(offset * hand.X),
        v(offset.linear() * hand.velocity.linear + math::shifted(rate, X.translation()).linear),
        w_own(X.linear().transpose() * (offset.linear() * hand.velocity.angular + rate.angular)) {}
  RigidTransform X;
  Vector3d v, w_own;
};

}  // namespace

void Proxy::place(const RigidTransform& offset, const Twist& rate) {
  *this = Proxy();
  behind_ = (offset.matrix() - RigidTransform::Identity().matrix()).cwiseAbs().maxCoeff() > no_offset;
  if (!behind_) return;
  offset_ = offset;
  rate_ = rate;
}

void Proxy::rest(const RigidTransform& before, const MotionState& now) {
  const RigidTransform X = offset_ * before;
  behind_ = true;
  offset_ = X * now.X.inverse();
  const ProxyMotion carried(now, offset_, Twist());
  rate_ = math::shifted(Twist{-carried.v, -(X.linear() * carried.w_own)}, -X.translation());
}

void Proxy::add_rate(const Twist& change, const Vector3d& p) {
  behind_ = true;
  rate_ = sum(rate_, math::shifted(change, -p));
}

Twist Proxy::rate_to(const RigidTransform& offset, const Vector3d& hand, double h) const {
  const RigidTransform by = offset * offset_.inverse();
  const Vector3d p = offset * hand;
  const Twist rate{(p - by.inverse() * p) / h, math::log_so3(by.linear()) / h};
  return math::shifted(rate, -p);
}

RigidTransform Proxy::reduced_to(double left) const {
  if (!behind_) return offset_;
  RigidTransform X;
  X.linear() = math::exp_so3(left * math::log_so3(offset_.linear()));
  X.translation() = left * offset_.translation();
  X.makeAffine();
  return X;
}

MotionSegment Proxy::motion(const MotionSegment& hand, double t, double h, const RigidTransform& offset,
                            const Twist& rate) const {
  const ProxyMotion a(hand.at(t), offset_, rate), b(hand.at(t + h), offset, rate);
  return MotionSegment({t, a.X}, a.v, a.w_own, {t + h, b.X}, b.v, b.w_own);
}

MotionSegment Proxy::motion(const MotionSegment& hand, double t) const {
  if (!behind_) return hand;
  const Vector3d turn = difference_time * rate_.angular;
  RigidTransform by = RigidTransform::Identity();
  by.linear() = math::exp_so3(turn);
  by.translation() = difference_time * (rate_.linear + 0.5 * turn.cross(rate_.linear));
  return motion(hand, t, difference_time, by * offset_, rate_);
}

bool Proxy::operator==(const Proxy& other) const {
  return behind_ == other.behind_ && offset_.matrix() == other.offset_.matrix() && rate_.linear == other.rate_.linear &&
         rate_.angular == other.rate_.angular;
}

}  // namespace spring_workbench::motion
