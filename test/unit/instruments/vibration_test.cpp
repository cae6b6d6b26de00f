// Vibration from impacts and jolts.
#include "spring_workbench/instruments/vibration.h"

#include <gtest/gtest.h>

#include <cmath>

namespace spring_workbench::instruments::vibration_test {
namespace {

tools::ToolState holding(double force, double force_scale = 1.0) {
  tools::ToolState tool;
  tool.held_object = "box";
  tool.tip_wrench_W.force = {0.0, 0.0, force};
  tool.force_scale = force_scale;
  return tool;
}

TEST(Vibration, AConstantLoadIsNotFelt) {
  Vibration vibration;
  for (int i = 0; i < 100; ++i) EXPECT_EQ(vibration.update_intensity(0.01 * i, holding(1000.0), 0.0), 0.0);
}

TEST(Vibration, AStrikeIsFeltInProportionInRealUnitsAndDiesAway) {
  for (const double scale : {1.0, 5.0}) {
    Vibration weak, strong;
    weak.update_intensity(0.0, holding(10.0, scale), 0.0);
    strong.update_intensity(0.0, holding(10.0, scale), 0.0);
    const double once = weak.update_intensity(0.01, holding(10.0, scale), 0.1 * scale);
    EXPECT_NEAR(once, 0.2, 1e-12);
    EXPECT_NEAR(strong.update_intensity(0.01, holding(10.0, scale), 0.2 * scale), 2.0 * once, 1e-12);
    EXPECT_NEAR(weak.update_intensity(0.06, holding(10.0, scale), 0.0), once * std::exp(-1.0), 1e-12);
    EXPECT_EQ(weak.update_intensity(0.2, holding(10.0, scale), 0.0), 0.0);
    EXPECT_EQ(strong.update_intensity(0.02, holding(10.0, scale), 1e3 * scale), 1.0);
  }
}

TEST(Vibration, AJoltIsTheRateOfTheForce) {
  for (const double dt : {0.001, 0.01}) {
    Vibration vibration;
    double force = 5.0, intensity = 0.0;
    for (int i = 0; i < 10; ++i, force += 500.0 * dt)
      intensity = vibration.update_intensity(dt * i, holding(force), 0.0);
    EXPECT_NEAR(intensity, 0.25, 1e-9) << dt;
  }
}

TEST(Vibration, GraspReleaseAndATimeJumpRestartIt) {
  Vibration vibration;
  vibration.update_intensity(0.0, tools::ToolState(), 0.0);
  EXPECT_EQ(vibration.update_intensity(0.01, holding(100.0), 1.0), 0.0);
  EXPECT_GT(vibration.update_intensity(0.02, holding(100.0), 1.0), 0.5);
  EXPECT_GT(vibration.update_intensity(0.02, holding(100.0), 0.0), 0.5);  // the same state again
  EXPECT_EQ(vibration.update_intensity(0.03, tools::ToolState(), 0.0), 0.0);
  vibration.update_intensity(0.04, holding(100.0), 0.0);
  EXPECT_GT(vibration.update_intensity(0.05, holding(100.0), 1.0), 0.5);
  EXPECT_EQ(vibration.update_intensity(0.01, holding(0.0), 1.0), 0.0);
}

}  // namespace
}  // namespace spring_workbench::instruments::vibration_test
