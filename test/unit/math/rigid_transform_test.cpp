#include "spring_workbench/math/rigid_transform.h"

#include <gtest/gtest.h>

#include "support/random_poses.h"

namespace spring_workbench::math::rigid_transform_test {
namespace {

TEST(RigidTransform, IsMadeFromAQuaternionOfAnyLength) {
  test_support::Random random(1);
  for (int i = 0; i < 100; ++i) {
    const RigidTransform X = random.pose(2.0);
    Quaterniond q(X.linear());
    q.coeffs() *= random.number(0.01, 100.0);
    const RigidTransform made = make_transform(X.translation(), q);
    EXPECT_TRUE(made.isApprox(X, 1e-14));
    EXPECT_TRUE((made * made.inverse()).isApprox(RigidTransform::Identity(), 1e-14));
  }
}

}  // namespace
}  // namespace spring_workbench::math::rigid_transform_test
