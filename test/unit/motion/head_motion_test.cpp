#include "spring_workbench/motion/head_motion.h"

#include <gtest/gtest.h>

#include <cmath>

#include "spring_workbench/math/so3.h"

namespace spring_workbench::motion {
namespace {

constexpr double interval = 1.0 / 60.0, frame = 1.0 / 75.0;  // [s] of the tracker and of the pictures

/// A head that moves and turns at constant rates.
RigidTransform head_at(double t) {
  const Vector3d w(0.1, -0.2, 0.6), v(0.3, 0.1, -0.05);
  return make_transform(Vector3d(v * t), Quaterniond(math::exp_so3(Vector3d(t * w))));
}

double distance(const RigidTransform& a, const RigidTransform& b) {
  return (a.translation() - b.translation()).norm() + math::turn_between(a, b).norm();
}

/// The newest sample at `now`, as tf has it.
double newest(double now) { return std::floor(now / interval) * interval; }

TEST(HeadMotion, ShowsTheNewestSampleWithoutLatency) {
  HeadMotion motion;
  for (int k = 0; k < 100; ++k) {
    const double stamp = newest(frame * k);
    EXPECT_EQ(motion.update(stamp, head_at(stamp), frame * k, 0.0).matrix(), head_at(stamp).matrix());
  }
}

/// Every frame shows a steady motion at its pose at the time of visibility, also between samples: the age of a sample
/// that waits for the next frame counts.
TEST(HeadMotion, IsWhereAnEvenMotionWillBe) {
  for (const double latency : {0.01, 0.033, 0.06}) {
    HeadMotion motion;
    double farthest = 0.0;
    for (int k = 0; k < 200; ++k) {
      const double now = frame * k, stamp = newest(now);
      const RigidTransform X = motion.update(stamp, head_at(stamp), now, latency);
      // The latency of a sample is unknown, so the time since the first frame that showed it counts.
      const double first_seen = std::ceil(stamp / frame - 1e-9) * frame;
      if (k > 20) farthest = std::max(farthest, distance(X, head_at(stamp + latency + now - first_seen)));
    }
    EXPECT_LT(farthest, 1e-6) << latency;
  }
}

TEST(HeadMotion, RestsAfterADropoutAndAJumpOfTime) {
  for (const double jump : {3.0, -3.0}) {
    HeadMotion motion;
    double t = 10.0;
    for (; t < 11.0; t += interval) motion.update(t, head_at(t), t, 0.05);
    const RigidTransform X = head_at(t + 5.0);
    EXPECT_EQ(motion.update(t + jump, X, t, 0.05).matrix(), X.matrix()) << jump;
  }
}

}  // namespace
}  // namespace spring_workbench::motion
