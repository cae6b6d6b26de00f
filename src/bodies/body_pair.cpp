#include "spring_workbench/bodies/body_pair.h"

#include <Eigen/Cholesky>
#include <utility>

#include "spring_workbench/math/so3.h"

namespace spring_workbench::bodies {
namespace {

/// How the first of two moves as seen from the second: from its centre to that of the first, and the velocities of the
/// first and of the place there that is fixed to the second.
struct Apart {
  Vector3d p_W, velocity_W, rate_W;
  Apart(const motion::MotionState& first, const motion::MotionState& second)
      : p_W(first.X.translation() - second.X.translation()),
        velocity_W(first.velocity.linear - second.velocity.linear),
        rate_W(first.velocity.angular - second.velocity.angular) {}
};

}  // namespace

BodyPair::BodyPair(FreeBody first, FreeBody second)
    : bodies_{std::move(first), std::move(second)}, X_2F_(bodies_.second.object().X.inverse()) {
  accept();
}

RigidTransform BodyPair::X_WF() const { return bodies_.second.object().X * X_2F_; }

motion::MotionState BodyPair::object() const {
  const motion::MotionState first = bodies_.first.object(), second = bodies_.second.object();
  const Apart apart(first, second);
  const RigidTransform X_FW = (second.X * X_2F_).inverse();
  motion::MotionState s;
  s.X = X_FW * first.X;
  s.velocity.linear = X_FW.linear() * (apart.velocity_W - second.velocity.angular.cross(apart.p_W));
  s.velocity.angular = X_FW.linear() * apart.rate_W;
  return s;
}

void BodyPair::accept() {
  const RigidTransform X_W1 = bodies_.first.object().X, X_W2 = bodies_.second.object().X;
  path_.push_back({(X_W2 * X_2F_).inverse() * X_W1, X_W1, X_W2});
}

BodyPair::Wrenches BodyPair::on_both(const Wrench& wrench_F, const Vector3d& apart_W,
                                     const Vector3d& rotation_W) const {
  const Matrix3d R_WF = math::exp_so3(rotation_W) * X_WF().linear();
  const Wrench first_W{R_WF * wrench_F.force, R_WF * wrench_F.moment};
  return {first_W, {-first_W.force, -first_W.moment - apart_W.cross(first_W.force)}};
}

// Under constant wrenches the mean distance of the centres, but for what is along the force, is that of uniform motion:
// with this lever the angular momentum of both does not change over a substep. F is taken where it is in its middle.

bool BodyPair::advance(double h, const Wrench& contact_F) {
  const motion::MotionState second = bodies_.second.object();
  const Apart apart(bodies_.first.object(), second);
  const Vector3d mean_W = apart.p_W + 0.5 * h * apart.velocity_W;
  const Wrenches w = on_both(contact_F, mean_W, 0.5 * h * second.velocity.angular);
  Bodies next = bodies_;
  if (!next.first.advance(h, w.first_W) || !next.second.advance(h, w.second_W)) return false;
  bodies_ = next;
  return true;
}

void BodyPair::correct(double h, const Wrench& change_F) {
  const motion::MotionState second = bodies_.second.object();
  const Apart apart(bodies_.first.object(), second);
  const Vector3d mean_W = apart.p_W - 0.5 * h * apart.velocity_W;
  const Wrenches w = on_both(change_F, mean_W, -0.5 * h * second.velocity.angular);
  bodies_.first.correct(h, w.first_W);
  bodies_.second.correct(h, w.second_W);
}

Matrix6d BodyPair::mobility() const {
  const Apart apart(bodies_.first.object(), bodies_.second.object());
  Matrix6d shift = Matrix6d::Identity(), to_F = Matrix6d::Zero();
  shift.topRightCorner<3, 3>() = -math::skew(apart.p_W);
  to_F.topLeftCorner<3, 3>() = to_F.bottomRightCorner<3, 3>() = X_WF().linear().transpose();
  const Matrix6d of_both_W = bodies_.first.mobility() + shift * bodies_.second.mobility() * shift.transpose();
  return to_F * of_both_W * to_F.transpose();
}

void BodyPair::add_impulse(const Wrench& impulse_F) {
  const Apart apart(bodies_.first.object(), bodies_.second.object());
  const Wrenches w = on_both(impulse_F, apart.p_W, Vector3d::Zero());
  bodies_.first.add_impulse(w.first_W);
  bodies_.second.add_impulse(w.second_W);
}

void BodyPair::block(double) { add_impulse(to_wrench(mobility().ldlt().solve(-to_vector(object().velocity)))); }

}  // namespace spring_workbench::bodies
