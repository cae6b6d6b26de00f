#include "spring_workbench/motion/slip.h"

#include <cmath>

#include "constants.h"
#include "spring_workbench/math/so3.h"

namespace spring_workbench::motion {

void Slip::begin(const RigidTransform& X_WS, const RigidTransform& X_WS_tool) {
  open_ = true;
  by_W_ = X_WS_tool.translation() - X_WS.translation();
  turn_S_ = math::turn_between(X_WS, X_WS_tool);
}

RigidTransform Slip::displaced(const RigidTransform& X_WS, double left) const {
  return make_transform(X_WS.translation() + left * by_W_, Quaterniond(X_WS.linear() * math::exp_so3(left * turn_S_)));
}

MotionSegment Slip::motion(const MotionSegment& hand, double now, double h) {
  if (!open_) return hand;
  left_ = std::exp(-h / slip_return_time);
  const MotionState a = hand.at(now), b = hand.at(now + h);
  const PoseSample begin{now, displaced(a.X, 1.0)}, end{now + h, displaced(b.X, left_)};
  const auto rate = [](const Vector3d& gap) { return Vector3d(-gap / slip_return_time); };
  return MotionSegment(
      begin, a.velocity.linear + rate(by_W_), begin.X.linear().transpose() * a.velocity.angular + rate(turn_S_), end,
      b.velocity.linear + left_ * rate(by_W_), end.X.linear().transpose() * b.velocity.angular + left_ * rate(turn_S_));
}

void Slip::accept() {
  if (!open_) return;
  by_W_ *= left_;
  turn_S_ *= left_;
  left_ = 1.0;
  if (by_W_.norm() + turn_S_.norm() < no_gap) open_ = false;
}

}  // namespace spring_workbench::motion
