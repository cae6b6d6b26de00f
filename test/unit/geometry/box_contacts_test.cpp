#include "spring_workbench/geometry/box_contacts.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "spring_workbench/math/so3.h"
#include "support/random_poses.h"

namespace spring_workbench::geometry::box_contacts_test {
namespace {

using test_support::Random;

// Where the edges of nearly flush boxes cross, the boxes are nearest, but a small turn closes the rest of their faces.
TEST(BoxContacts, OfNearlyFlushBoxesLetNoSmallMotionPassThatOverlaps) {
  Random random(3);
  const OutlineBox below{RigidTransform::Identity(), Vector3d(0.05, 0.05, 0.025), true};
  int apart = 0, overlapping = 0;
  for (int i = 0; i < 2000; ++i) {
    OutlineBox above{RigidTransform::Identity(), Vector3d::Constant(0.05), true};
    const Vector3d tilt = 0.02 * random.vector(1.0), aside = 0.05 * random.vector(1.0);
    above.X.linear() = math::exp_so3(Vector3d(tilt.x(), tilt.y(), random.vector(1.0).z()));
    above.X.translation() = Vector3d(aside.x(), aside.y(), 0.1);
    above.X.translation().z() -= gap_between(above, below).gap - 2e-4;
    const Vector3d move = 3e-4 * random.vector(1.0), turn = 0.01 * random.vector(1.0);
    double gap = 1.0;
    for (const BoxContact& c : box_contacts(above, below, 3e-3)) {
      gap = std::min(gap, c.gap + c.n_W.dot(move + turn.cross(c.p_W - above.X.translation())));
    }
    if (gap < 0.0) continue;
    ++apart;
    above.X.translation() += move;
    above.X.linear() = math::exp_so3(turn) * above.X.linear();
    if (gap_between(above, below).gap < -5e-5) ++overlapping;
  }
  EXPECT_GT(apart, 200);
  EXPECT_LT(overlapping, 0.01 * apart);  // of up to eight points four are kept
}

}  // namespace
}  // namespace spring_workbench::geometry::box_contacts_test
