#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>

#include "spring_workbench/rod/shape_model.h"
#include "support/named.h"

namespace spring_workbench::rod::elastica_test {
namespace {

/// A cantilever's tip under a transverse dead load: slope [rad], deflection and shortening over the length.
struct Elastica {
  double alpha, slope, deflection, shortening;
};

/// Static answer of a shape model: K q = Jᵀ P, by Newton with differences, the load raised in small steps.
Elastica solve(const std::string& name, double alpha) {
  const double L = 0.2;
  const PerDof k{1e10, 500.0, 1e10};  // neither extension nor twist
  const auto made = rod::make_shape_model(test_support::shape_named(name), L);
  const ShapeModel& shape = *made;
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
        const double step = 1e-5 * K[0] / std::max(K[0], K[j]);
        up[j] += step;
        down[j] -= step;
        slope.col(j) = (residual(up) - residual(down)) / (up[j] - down[j]);
      }
      q -= slope.partialPivLu().solve(residual(q));
    }
  }
  shape.tip(q, none, tip);
  const double slope = std::atan2(tip.R_HE(0, 2), tip.R_HE(2, 2));
  return {alpha, slope, tip.p_HE.x() / L, 1.0 - tip.p_HE.z() / L};
}

TEST(Elastica, ShapesFollowTheTable) {
  // doc/model.md; exact elastica: 0.46135 0.30172 0.05643, 0.78175 0.49346 0.16064, 1.21537 0.71379 0.38763,
  // 1.43029 0.81061 0.55500.
  const Elastica linear[] = {{1.0, 0.46127, 0.30165, 0.05650},
                             {2.0, 0.78062, 0.49259, 0.16097},
                             {5.0, 1.20338, 0.70640, 0.38716},
                             {10.0, 1.39096, 0.79180, 0.54965}};
  const Elastica constant[] = {{1.0, 0.60658, 0.29411, 0.06021},
                               {2.0, 1.01130, 0.46400, 0.16195},
                               {5.0, 1.56115, 0.63437, 0.35948},
                               {10.0, 1.87128, 0.69257, 0.48955}};
  const auto follows = [](const char* name, const Elastica(&table)[4]) {
    for (const Elastica& row : table) {
      const Elastica found = solve(name, row.alpha);
      EXPECT_NEAR(found.slope, row.slope, 1e-5) << name << " " << row.alpha;
      EXPECT_NEAR(found.deflection, row.deflection, 1e-5) << name << " " << row.alpha;
      EXPECT_NEAR(found.shortening, row.shortening, 1e-5) << name << " " << row.alpha;
    }
  };
  follows("linear", linear);
  follows("constant", constant);
}

TEST(Elastica, EveryRodAgreesForSmallLoads) {
  // w/L → α/3 as α → 0; the exact elastica differs from that by α³ terms.
  for (const char* name : {"constant", "linear"}) {
    EXPECT_NEAR(solve(name, 1e-3).deflection, 1e-3 / 3.0, 1e-9) << name;
  }
}

}  // namespace
}  // namespace spring_workbench::rod::elastica_test
