#include "spring_workbench/tools/calibration.h"

#include <gtest/gtest.h>

namespace spring_workbench {
namespace {

TEST(Calibration, StaticDeformationIsTheSetFractionOverTwelveDecadesOfMass) {
  const CalibrationGoal goal{0.04, 0.12, 0.3};
  for (double mass = 1e-6; mass < 2e6; mass *= 10.0) {
    const PerFamily k = calibrated_stiffness(mass, 0.05, 0.2, 9.81, goal);
    EXPECT_NEAR(mass * 9.81 / k.stretch, 0.04 * 0.2, 1e-12);
    EXPECT_NEAR(mass * 9.81 / k.bend, 0.12 * 0.2, 1e-12);
    EXPECT_NEAR(mass * 9.81 * 0.05 / k.torsion, 0.3, 1e-12);
  }
}

TEST(Calibration, WithoutMassOrGravityStiffnessStaysPositive) {
  EXPECT_GT(calibrated_stiffness(0.0, 0.05, 0.2, 9.81).stretch, 0.0);
  EXPECT_GT(calibrated_stiffness(1.0, 0.05, 0.2, 0.0).torsion, 0.0);
}

}  // namespace
}  // namespace spring_workbench
