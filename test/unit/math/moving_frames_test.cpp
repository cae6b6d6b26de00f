// Twists and wrenches of frames that move.
#include "spring_workbench/math/moving_frames.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "spring_workbench/math/so3.h"

namespace spring_workbench::math::moving_frames_test {
namespace {

/// It turns one vector onto the other, by the angle between them, also if they are parallel or opposite.
TEST(MovingFrames, ShortestRotationTurnsByTheAngleBetween) {
  std::mt19937 random(5);
  std::normal_distribution<double> normal;
  const auto any = [&] { return Vector3d(normal(random), normal(random), normal(random)); };
  for (int i = 0; i < 1000; ++i) {
    const Vector3d a = any(), b = i % 10 == 0 ? Vector3d(-2.0 * a) : i % 10 == 1 ? Vector3d(3.0 * a) : any();
    const Matrix3d R = shortest_rotation(a, b);
    // Close to opposite vectors the angle loses digits: half of them at most.
    const double exact = 1e-14 / std::max(1e-7, 1.0 + a.normalized().dot(b.normalized()));
    EXPECT_LT((R * a.normalized() - b.normalized()).norm(), exact);
    EXPECT_LT((R.transpose() * R - Matrix3d::Identity()).norm(), exact);
    EXPECT_NEAR(log_so3(R).norm(), std::atan2(a.cross(b).norm(), a.dot(b)), exact);
  }
}

/// Also far from z and where the frame itself turns; at half a turn there is no shortest way.
TEST(MovingFrames, AlignedRateIsTheDerivativeOfTheShortestTurn) {
  std::mt19937 random(7);
  std::normal_distribution<double> normal;
  const auto any = [&] { return Vector3d(normal(random), normal(random), normal(random)); };
  for (int i = 0; i < 1000; ++i) {
    const Vector3d w = any(), n0 = any().normalized(), n_dot = any().cross(n0), theta = any();
    const auto aligned = [&](double t) {
      const Matrix3d R = exp_so3(t * w) * exp_so3(theta);
      const Vector3d n = (n0 + t * n_dot).normalized();
      return Matrix3d(shortest_rotation(R.col(2), n) * R);
    };
    if (exp_so3(theta).col(2).dot(n0) < -0.9) continue;
    constexpr double dt = 1e-6;
    const Vector3d expected = log_so3(aligned(dt) * aligned(-dt).transpose()) / (2.0 * dt);
    EXPECT_LT((aligned_rate(exp_so3(theta), w, n0, n_dot) - expected).norm(), 1e-6 * (1.0 + 100.0 * expected.norm()));
  }
  const Vector3d w(1.0, 2.0, 3.0);
  EXPECT_EQ(aligned_rate(Matrix3d::Identity(), w, -Vector3d::UnitZ(), Vector3d::UnitX()), w);
}

/// The power of a wrench on a rigid body is the same about any of its points.
TEST(MovingFrames, ThePowerIsTheSameAtEveryPoint) {
  const Twist V{{1.0, -2.0, 0.5}, {0.3, 0.7, -1.1}};
  const Wrench F{{3.0, 1.0, -4.0}, {0.2, -0.6, 0.9}};
  const Vector3d p(0.4, -0.1, 0.25);
  EXPECT_NEAR(to_vector(F).dot(to_vector(V)), to_vector(shifted(F, -p)).dot(to_vector(shifted(V, p))), 1e-14);
}

}  // namespace
}  // namespace spring_workbench::math::moving_frames_test
