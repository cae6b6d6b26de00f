#include "spring_workbench/motion/pose_follower.h"

#include <gtest/gtest.h>

#include "spring_workbench/math/so3.h"
#include "support/random_poses.h"

namespace spring_workbench::motion::pose_follower_test {
namespace {

double distance(const RigidTransform& a, const RigidTransform& b) { return (a.translation() - b.translation()).norm(); }
double angle(const RigidTransform& a, const RigidTransform& b) {
  return math::log_so3(a.linear().transpose() * b.linear()).norm();
}

TEST(PoseFollower, StaysWithoutGoal) {
  const RigidTransform start = make_transform(Vector3d(0.1, 0.2, 0.3), Quaterniond(1.0, 2.0, 3.0, 4.0));
  PoseFollower follower(start);
  for (int i = 0; i < 10; ++i) EXPECT_TRUE(follower.advance(0.02).isApprox(start, 1e-15));
}

TEST(PoseFollower, ReachesEveryGoalWithoutOvershootAndNeverFasterThanAHand) {
  test_support::Random random(7);
  PoseFollower follower(RigidTransform::Identity());
  RigidTransform last = RigidTransform::Identity();
  for (int round = 0; round < 50; ++round) {
    const RigidTransform goal = random.pose(0.5);
    follower.set_goal(goal);
    for (int i = 0; i < 300; ++i) {
      const double dt = 0.02;
      const RigidTransform X = follower.advance(dt);
      ASSERT_LE(distance(last, X), PoseFollower::max_speed * dt * (1.0 + 1e-9) + 1e-12);
      ASSERT_LE(angle(last, X), PoseFollower::max_turn_rate * dt * (1.0 + 1e-9) + 1e-9);
      ASSERT_LE(distance(X, goal), distance(last, goal) + 1e-12);
      ASSERT_LE(angle(X, goal), angle(last, goal) + 1e-9);
      last = X;
    }
    EXPECT_LT(distance(last, goal), 1e-9);
    EXPECT_LT(angle(last, goal), 1e-7);
  }
}

TEST(PoseFollower, NearAGoalThePathDoesNotDependOnTheSteps) {
  const RigidTransform goal =
      make_transform(Vector3d(0.003, 0.0, 0.004), Quaterniond(math::exp_so3(Vector3d(0.01, 0.02, 0.0))));
  PoseFollower coarse(RigidTransform::Identity()), fine(RigidTransform::Identity());
  coarse.set_goal(goal);
  fine.set_goal(goal);
  const RigidTransform in_one = coarse.advance(0.024);
  for (int i = 0; i < 7; ++i) fine.advance(0.003);
  EXPECT_TRUE(fine.advance(0.003).isApprox(in_one, 1e-12));
  // One time constant leaves 1/e of the way.
  PoseFollower one(RigidTransform::Identity());
  one.set_goal(goal);
  EXPECT_NEAR(distance(one.advance(PoseFollower::time_constant), goal), 0.005 * std::exp(-1.0), 1e-12);
}

}  // namespace
}  // namespace spring_workbench::motion::pose_follower_test
