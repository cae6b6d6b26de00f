#include "spring_workbench/geometry/moving_solids.h"

#include <algorithm>

#include "spring_workbench/math/so3.h"

namespace spring_workbench::geometry {

RigidTransform SteadyMotion::moved(const RigidTransform& X_WS, double h) const {
  const Matrix3d turn = math::exp_so3(h * w_W);
  RigidTransform X = X_WS;
  X.linear() = turn * X_WS.linear();
  X.translation() = p_W + h * v_W + turn * (X_WS.translation() - p_W);
  return X;
}

double approach_speed(const SteadyMotion& a, const SteadyMotion& b) {
  const auto approach = [](const SteadyMotion& x, const SteadyMotion& y) {
    const Vector3d w = x.w_W - y.w_W;
    return (x.v_W - y.v_W - y.w_W.cross(x.p_W - y.p_W)).norm() + (w.isZero(0.0) ? 0.0 : x.radius * w.norm());
  };
  return std::min(approach(a, b), approach(b, a));
}

void let_pass(const Solid& a, const RigidTransform& X_WA, const SteadyMotion& motion_a, const Solid& b,
              const RigidTransform& X_WB, const SteadyMotion& motion_b, double h, double min_gap,
              std::vector<BoxContact>& contacts) {
  const auto support = [](const Solid& solid, const RigidTransform& X_WS, const Vector3d& n_W) -> Vector3d {
    return X_WS * furthest(solid, X_WS.linear().transpose() * n_W);
  };
  for (BoxContact& c : contacts) {
    const Vector3d motion = h * (motion_a.velocity_at(c.p_W) - motion_b.velocity_at(c.p_W));
    if (!(c.gap > min_gap && c.gap + c.n_W.dot(motion) < 0.0)) continue;
    const Vector3d across = c.n_W - c.n_W.dot(motion) / motion.squaredNorm() * motion;
    if (across.isZero(0.0)) continue;
    const Vector3d n = across.normalized();
    const Vector3d on_b = support(b, X_WB, n);
    const double gap = n.dot(support(a, X_WA, -n) - on_b);
    const double at_end = n.dot(support(a, motion_a.moved(X_WA, h), -n) - support(b, motion_b.moved(X_WB, h), n));
    if (std::min(gap, at_end) > 0.0) c = {on_b, n, gap};
  }
}

}  // namespace spring_workbench::geometry
