#include "spring_workbench/motion/pose_predictor.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "spring_workbench/math/so3.h"

namespace spring_workbench::motion::pose_predictor_test {
namespace {

PoseSample at(double t, const Vector3d& p, double turned) {
  return {t, make_transform(Quaterniond(math::exp_so3(Vector3d(0.0, turned, 0.0))), p)};
}

/// Lines and parabolas are continued exactly.
TEST(PosePredictor, FollowsLineAndParabolaExactly) {
  const Vector3d v(0.3, -0.2, 0.1), a(2.0, 1.0, -3.0);
  const auto parabola = [&](double t) { return at(t, t * v + t * t * a, 0.4 * t + 0.9 * t * t); };
  PosePredictor line, curve;
  for (int k = 0; k <= 75; ++k) {
    line.push(at(0.008 * k, 0.008 * k * v, 0.004 * k));
    curve.push(parabola(0.008 * k));
  }
  for (const double ahead : {0.001, 0.005, 0.019, 0.05, 0.1}) {
    const double t = 0.6 + ahead;
    EXPECT_LT((line.predict(t)->X.matrix() - at(t, t * v, 0.5 * t).X.matrix()).norm(), 1e-9);
    EXPECT_LT((curve.predict(t)->X.translation() - parabola(t).X.translation()).norm(), 1e-9) << ahead;
    EXPECT_EQ(curve.predict(t)->t, t);
  }
  EXPECT_LT((curve.predict(0.65)->X.linear() - parabola(0.65).X.linear()).norm(), 1e-9);
}

/// After a corner, the prediction is straight once the corner is older than the window, and not before.
TEST(PosePredictor, ForgetsWhatIsOlderThanItsWindow) {
  const auto corner = [](double t) { return at(t, Vector3d(t, std::max(0.0, t - 0.4), 0.0), 0.0); };
  PosePredictor predictor;
  for (int k = 0; k <= 120; ++k) {
    const double t = 0.005 * k;
    predictor.push(corner(t));
    const double error = (predictor.predict(t + 0.02)->X.translation() - corner(t + 0.02).X.translation()).norm();
    if (t > 0.42 && t < 0.535) {
      EXPECT_GT(error, 1e-6) << t;
    }
    if (t > 0.545) {
      EXPECT_LT(error, 1e-9) << t;
    }
  }
}

TEST(PosePredictor, RestsBeyondItsReachAndWhereNothingIsKnown) {
  PosePredictor predictor;
  EXPECT_FALSE(predictor.predict(1.0));
  const Vector3d p(0.1, 0.2, 0.3);
  predictor.push(at(0.0, p, 0.1));
  EXPECT_FALSE(predictor.predict(0.0));
  EXPECT_EQ(predictor.predict(0.05)->X.matrix(), at(0.0, p, 0.1).X.matrix());
  predictor.push(at(0.03, p + Vector3d(0.03, 0.0, 0.0), 0.1));  // slower than the window
  EXPECT_NEAR(predictor.predict(0.04)->X.translation().x(), 0.14, 1e-12);
  EXPECT_EQ(predictor.predict(10.0)->t, 0.03 + PosePredictor::farthest);
  predictor.restart();
  EXPECT_FALSE(predictor.predict(1.0));
}

}  // namespace
}  // namespace spring_workbench::motion::pose_predictor_test
