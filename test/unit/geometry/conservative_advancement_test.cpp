#include "spring_workbench/geometry/conservative_advancement.h"

#include <gtest/gtest.h>

#include <cmath>

#include "spring_workbench/math/so3.h"
#include "support/random_poses.h"

namespace spring_workbench::geometry::conservative_advancement_test {
namespace {

using test_support::Random;

OutlineBox moved(const OutlineBox& box, const StraightMotion& motion, double fraction) {
  const Matrix3d R = math::exp_so3(fraction * motion.turn_W);
  OutlineBox at = box;
  at.X.linear() = R * box.X.linear();
  at.X.translation() = motion.p_WO + fraction * motion.move_W + R * (box.X.translation() - motion.p_WO);
  return at;
}

TEST(ClearWay, NoBoxIsDeeperOnItThanTheTolerance) {
  Random random(7);
  int cut = 0, long_paths = 0;
  for (int i = 0; i < 2000; ++i) {
    const auto size = [&] { return Vector3d(random.vector(0.1).cwiseAbs() + Vector3d::Constant(0.005)); };
    const OutlineBox own{random.pose(0.2), size(), true}, other{random.pose(0.2), size(), true};
    const StraightMotion motion{own.X.translation() + random.vector(0.2), random.vector(0.5), random.vector(2.0)};
    const double tolerance = i % 2 ? 1e-3 : 0.0;
    if (gap_between(own, other).gap < -tolerance) continue;
    const double clear = free_fraction_to(own, motion, other, tolerance, 1.0);
    ASSERT_GE(clear, 0.0);
    ASSERT_LE(clear, 1.0);
    if (clear < 1.0) ++cut;
    if (clear > 0.05) ++long_paths;
    for (int k = 0; k <= 20; ++k) {
      EXPECT_GE(gap_between(moved(own, motion, clear * k / 20.0), other).gap, -tolerance - 1e-12) << i;
    }
  }
  EXPECT_GT(cut, 200);
  EXPECT_GT(long_paths, 200);
}

TEST(ClearWay, WithANewPlaneWhereTheLastOneEndsItLeadsToTheTouch) {
  Random random(8);
  int longer = 0;
  for (int i = 0; i < 1000; ++i) {
    const auto size = [&] { return Vector3d(random.vector(0.1).cwiseAbs() + Vector3d::Constant(0.005)); };
    const OutlineBox own{random.pose(0.2), size(), true}, other{random.pose(0.2), size(), true};
    const StraightMotion motion{own.X.translation(), random.vector(0.5), random.vector(2.0)};
    const double tolerance = i % 2 ? 1e-3 : 0.0;
    if (gap_between(own, other).gap < -tolerance) continue;
    const double clear = free_fraction_past(own, motion, other, tolerance, 1.0);
    for (int k = 0; k <= 20; ++k) {
      EXPECT_GE(gap_between(moved(own, motion, clear * k / 20.0), other).gap, -tolerance - 1e-12) << i;
    }
    if (free_fraction_to(own, motion, other, tolerance, 1.0) < clear - 0.05) ++longer;
    if (clear == 1.0) continue;
    const double path = motion.move_W.norm() + motion.turn_W.norm() * own.half.norm();
    EXPECT_LT(gap_between(moved(own, motion, clear), other).gap, -tolerance + 0.02 * path) << i;
  }
  EXPECT_GT(longer, 50);
}

TEST(ClearWay, StraightOntoAFaceItIsExact) {
  const OutlineBox own{RigidTransform(Eigen::Translation3d(0, 0, 0.5)), Vector3d::Constant(0.1), true};
  const OutlineBox other{RigidTransform::Identity(), Vector3d(1.0, 1.0, 0.1), true};
  const StraightMotion motion{own.X.translation(), Vector3d(0.2, 0.1, -1.0), Vector3d::Zero()};
  EXPECT_NEAR(free_fraction_to(own, motion, other, 0.0, 1.0), 0.3, 1e-12);
  EXPECT_NEAR(free_fraction_to(own, motion, other, 0.01, 1.0), 0.31, 1e-12);
  EXPECT_NEAR(free_fraction_above(own, motion, {Vector3d::UnitZ(), 0.1}, 0.0, 1.0), 0.3, 1e-12);
  EXPECT_EQ(free_fraction_to(own, motion, other, 0.0, 0.2), 0.2);
}

TEST(ClearWay, SlidingAndTurningFlushOnAFaceIsFree) {
  const OutlineBox own{RigidTransform(Eigen::Translation3d(0, 0, 0.2)), Vector3d::Constant(0.1), true};
  const OutlineBox other{RigidTransform::Identity(), Vector3d(1.0, 1.0, 0.1), true};
  const StraightMotion motion{own.X.translation(), Vector3d(0.5, 0.0, 0.0), Vector3d(0.0, 0.0, 3.0)};
  EXPECT_EQ(free_fraction_to(own, motion, other, 1e-9, 1.0), 1.0);
}

}  // namespace
}  // namespace spring_workbench::geometry::conservative_advancement_test
