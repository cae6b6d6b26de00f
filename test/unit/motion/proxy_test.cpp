#include "spring_workbench/motion/proxy.h"

#include <gtest/gtest.h>

#include <random>

#include "spring_workbench/math/so3.h"
#include "spring_workbench/math/spatial.h"

namespace spring_workbench::motion::proxy_test {
namespace {

using Random = std::mt19937;

Vector3d any(Random& random, double size) {
  std::uniform_real_distribution<double> uniform(-size, size);
  return {uniform(random), uniform(random), uniform(random)};
}

RigidTransform any_pose(Random& random, double angle) {
  return make_transform(any(random, 0.5), Quaterniond(math::exp_so3(any(random, angle))));
}

MotionSegment any_hand(Random& random) {
  const RigidTransform X = any_pose(random, 2.0);
  const PoseSample a{0.0, X},
      b{0.02, X * make_transform(any(random, 0.02), Quaterniond(math::exp_so3(any(random, 0.1))))};
  return MotionSegment(a, any(random, 1.0), any(random, 5.0), b, any(random, 1.0), any(random, 5.0));
}

/// An offset after `t` [s], in which it has moved with a constant rate at the origin.
RigidTransform moved(const RigidTransform& offset, const Twist& rate, double t) {
  RigidTransform by = RigidTransform::Identity();
  by.linear() = math::exp_so3(t * rate.angular);
  by.translation() = math::right_jacobian_so3(-t * rate.angular) * (t * rate.linear);
  return by * offset;
}

TEST(Proxy, AtPresentIsMovedByTheHandAndByItsOffset) {
  Random random(1);
  for (int i = 0; i < 100; ++i) {
    const MotionSegment hand = any_hand(random);
    const RigidTransform offset = any_pose(random, 0.3);
    const Twist rate{any(random, 0.5), any(random, 1.0)};
    const double t = 0.01, d = 2e-5;
    const auto exact = [&](double u) { return moved(offset, rate, u) * hand.at(t + u).X; };
    Proxy proxy;
    proxy.place(offset, rate);
    ASSERT_TRUE(proxy.behind());
    const MotionState s = proxy.motion(hand, t).at(t);
    const Vector3d p = exact(0.0).translation(), ahead = exact(d).translation(), back = exact(-d).translation();
    EXPECT_LT((s.X.translation() - p).norm(), 1e-14) << i;
    EXPECT_LT((s.velocity.linear - (ahead - back) / (2.0 * d)).norm(), 1e-4) << i;
    const Vector3d acceleration = (ahead - 2.0 * p + back) / (d * d);
    EXPECT_LT((s.acceleration.linear - acceleration).norm(), 0.01 * (1.0 + acceleration.norm())) << i;
    const Vector3d w = exact(0.0).linear() * math::turn_between(exact(-d), exact(d)) / (2.0 * d);
    EXPECT_LT((s.velocity.angular - w).norm(), 1e-3) << i;
  }
}

TEST(Proxy, GoesOverAStepWithTheRateThatItThenHas) {
  Random random(2);
  for (int i = 0; i < 100; ++i) {
    const MotionSegment hand = any_hand(random);
    const RigidTransform offset = any_pose(random, 0.3);
    const Twist rate{any(random, 0.5), any(random, 1.0)};
    const double t = 0.005, h = 0.002;
    Proxy proxy;
    proxy.place(offset, Twist());
    const RigidTransform end = moved(offset, rate, h);
    const Twist mean = proxy.rate_to(end, hand.at(t + h).X.translation(), h);
    EXPECT_LT((to_vector(mean) - to_vector(rate)).norm(), 0.01) << i;
    const MotionSegment path = proxy.motion(hand, t, h, end, mean);
    EXPECT_LT((path.at(t).X.matrix() - (offset * hand.at(t).X).matrix()).norm(), 1e-14) << i;
    EXPECT_LT((path.at(t + h).X.matrix() - (end * hand.at(t + h).X).matrix()).norm(), 1e-14) << i;
    proxy.place(end, mean);
    const MotionState now = proxy.motion(hand, t + h).at(t + h), then = path.at(t + h);
    EXPECT_LT((to_vector(now.velocity) - to_vector(then.velocity)).norm(), 1e-10) << i;
  }
}

TEST(Proxy, RestsAndIsKicked) {
  Random random(3);
  for (int i = 0; i < 100; ++i) {
    const MotionSegment hand = any_hand(random);
    Proxy proxy;
    proxy.rest(hand.at(0.0).X, hand.at(0.015));
    MotionState s = proxy.motion(hand, 0.015).at(0.015);
    EXPECT_LT((s.X.matrix() - hand.at(0.0).X.matrix()).norm(), 1e-12) << i;
    EXPECT_LT(to_vector(s.velocity).norm(), 1e-11) << i;
    const Twist change{any(random, 1.0), any(random, 1.0)};
    const Vector3d p = any(random, 1.0);
    proxy.add_rate(change, p);
    s = proxy.motion(hand, 0.015).at(0.015);
    EXPECT_LT((s.velocity.linear + s.velocity.angular.cross(p - s.X.translation()) - change.linear).norm(), 1e-11) << i;
    EXPECT_LT((s.velocity.angular - change.angular).norm(), 1e-11) << i;
  }
}

TEST(Proxy, ThatHasComeBackIsTheHand) {
  Random random(4);
  const MotionSegment hand = any_hand(random);
  RigidTransform offset = any_pose(random, 0.3);
  Proxy proxy;
  for (int i = 0; i < 400 && (i == 0 || proxy.behind()); ++i) {
    proxy.place(offset, Twist());
    offset = proxy.reduced_to(0.9);
  }
  EXPECT_FALSE(proxy.behind());
  EXPECT_EQ(proxy.motion(hand, 0.01).at(0.01).X.matrix(), hand.at(0.01).X.matrix());
  EXPECT_LT((hand.at(0.01).X.matrix() - (offset * hand.at(0.01).X).matrix()).norm(), 1e-8);
}

}  // namespace
}  // namespace spring_workbench::motion::proxy_test
