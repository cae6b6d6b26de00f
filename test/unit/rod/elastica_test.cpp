#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>

#include "spring_workbench/rod/shape_model.h"

namespace spring_workbench {
namespace {

/// A cantilever's tip under a transverse dead load: slope [rad], deflection and shortening over the length.
struct Elastica {
  double alpha, slope, deflection, shortening;
};

/// Static answer of a shape model: K q = Jᵀ P, by Newton with differences, the load raised in small steps.
Elastica solve(const ShapeModel& shape, double alpha) {
  const double L = shape.length();
  const PerFamily k{1e12, 500.0, 1e12};  // neither extension nor twist
  const double EI = k.bend * L * L * L / 3.0;
  const StrainVector K = shape.stiffness(k), none = StrainVector::Zero(shape.size());
  TipKinematics tip;
  StrainVector q = none;
  for (int stage = 1; stage <= 20; ++stage) {
    const Vector3d P(alpha * EI / (L * L) * stage / 20.0, 0.0, 0.0);
    const auto residual = [&](const StrainVector& at) {
      shape.tip(at, none, tip);
      return StrainVector(K.cwiseProduct(at) - tip.linear.transpose() * P);
    };
    for (int newton = 0; newton < 30; ++newton) {
      StrainMatrix slope(shape.size(), shape.size());
      for (int j = 0; j < shape.size(); ++j) {
        StrainVector up = q, down = q;
        up[j] += 1e-5;
        down[j] -= 1e-5;
        slope.col(j) = (residual(up) - residual(down)) / 2e-5;
      }
      q -= slope.partialPivLu().solve(residual(q));
    }
  }
  shape.tip(q, none, tip);
  const double slope = std::atan2(tip.R_HE(0, 2), tip.R_HE(2, 2));
  return {alpha, slope, tip.p_HE.x() / L, 1.0 - tip.p_HE.z() / L};
}

TEST(Elastica, LinearCurvatureFollowsTheTable) {
  // doc/model.md; exact elastica beside it: 0.46135 0.30172 0.05643, 0.78175 0.49346 0.16064, 1.21537 0.71379 0.38763.
  const Elastica table[] = {{1.0, 0.46127, 0.30165, 0.05650},
                            {2.0, 0.78062, 0.49259, 0.16097},
                            {5.0, 1.20338, 0.70640, 0.38716},
                            {10.0, 1.39096, 0.79180, 0.54965}};
  const auto shape = make_shape_model("linear", 0.2);
  for (const Elastica& row : table) {
    const Elastica found = solve(*shape, row.alpha);
    EXPECT_NEAR(found.slope, row.slope, 1e-5) << row.alpha;
    EXPECT_NEAR(found.deflection, row.deflection, 1e-5) << row.alpha;
    EXPECT_NEAR(found.shortening, row.shortening, 1e-5) << row.alpha;
  }
}

TEST(Elastica, EveryRodAgreesForSmallLoads) {
  // w/L → α/3 as α → 0; the exact elastica differs from that by α³ terms.
  for (const char* name : {"constant", "linear"}) {
    const Elastica found = solve(*make_shape_model(name, 0.2), 1e-3);
    EXPECT_NEAR(found.deflection, 1e-3 / 3.0, 1e-9) << name;
  }
}

}  // namespace
}  // namespace spring_workbench
