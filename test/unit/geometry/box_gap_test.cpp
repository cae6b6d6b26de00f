#include "spring_workbench/geometry/box_gap.h"

#include <gtest/gtest.h>

#include <random>

#include "spring_workbench/math/so3.h"

namespace spring_workbench::geometry::box_gap_test {
namespace {

class Outlines : public ::testing::Test {
 protected:
  Vector3d in_cube() { return Vector3d(unit_(random_), unit_(random_), unit_(random_)); }
  OutlineBox any_box(double spread) {
    OutlineBox box;
    box.X = make_transform(spread * in_cube(), Quaterniond(math::exp_so3(3.0 * in_cube())));
    box.half = Vector3d::Constant(0.01) + 0.5 * in_cube().cwiseAbs();
    return box;
  }
  std::mt19937 random_{5};
  std::uniform_real_distribution<double> unit_{-1.0, 1.0};
};

TEST_F(Outlines, NoTwoPointsAreNearerAlongTheAxisThanTheGap) {
  for (int i = 0; i < 1000; ++i) {
    const OutlineBox a = any_box(2.0), b = any_box(2.0);
    const BoxGap gap = gap_between(a, b);
    EXPECT_NEAR(gap.n_W.norm(), 1.0, 1e-12);
    for (int k = 0; k < 20; ++k) {
      const Vector3d p = a.X * a.half.cwiseProduct(in_cube()), q = b.X * b.half.cwiseProduct(in_cube());
      EXPECT_GE(gap.n_W.dot(p - q), gap.gap - 1e-12);
    }
  }
}

TEST_F(Outlines, MovedApartByTheirOverlapTheyTouch) {
  for (int i = 0; i < 1000; ++i) {
    OutlineBox a = any_box(0.3);
    const OutlineBox b = any_box(0.3);
    const BoxGap gap = gap_between(a, b);
    if (gap.gap >= 0.0) continue;
    a.X.translation() -= gap.gap * gap.n_W;
    EXPECT_NEAR(gap_between(a, b).gap, 0.0, 1e-9);
  }
}

TEST_F(Outlines, TheGapChangesSidesWithItsSign) {
  for (int i = 0; i < 200; ++i) {
    const OutlineBox a = any_box(2.0), b = any_box(2.0);
    const BoxGap there = gap_between(a, b), back = gap_between(b, a);
    EXPECT_NEAR(there.gap, back.gap, 1e-12);
    EXPECT_NEAR((there.n_W + back.n_W).norm(), 0.0, 1e-9);
  }
}

TEST(Outline, IsExactForABoxAlone) {
  std::vector<Shape> shapes;
  shapes.push_back({Box{Vector3d(0.2, 0.4, 0.6)}});
  shapes.push_back({Sphere{0.1}});
  const std::vector<OutlineBox> boxes = outline(shapes);
  ASSERT_EQ(boxes.size(), 2u);
  EXPECT_TRUE(boxes[0].exact);
  EXPECT_FALSE(boxes[1].exact);
  EXPECT_NEAR((boxes[0].half - Vector3d(0.1, 0.2, 0.3)).norm(), 0.0, 1e-12);
  EXPECT_NEAR(gap_above(boxes[0], -1.0).gap, 0.7, 1e-12);
}

}  // namespace
}  // namespace spring_workbench::geometry::box_gap_test
