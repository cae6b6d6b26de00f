#include "spring_workbench/instruments/reading_average.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace spring_workbench::instruments::reading_average_test {
namespace {

tools::ToolState carrying(double weight, double torque = 0.0, const std::string& object = "box") {
  tools::ToolState tool;
  tool.held_object = object;
  tool.weight = weight;
  tool.torque = torque;
  return tool;
}

/// White noise on a weight of 3 vkg: the truth is in the interval of Student's t with nine degrees of freedom in 95 %.
TEST(ReadingAverage, IntervalsHaveTheirNominalCoverage) {
  std::mt19937 random(7);
  std::normal_distribution<double> noise(0.0, 0.2);
  int covered = 0, torque_covered = 0;
  constexpr int runs = 2000;
  for (int run = 0; run < runs; ++run) {
    ReadingAverage average;
    tools::ToolState tool;
    for (int i = 0; i <= 60; ++i) average.add(0.02 * i, tool = carrying(3.0 + noise(random), -0.1 + noise(random)));
    covered += std::abs(tool.weight_average.mean - 3.0) < 2.262 * tool.weight_average.uncertainty ? 1 : 0;
    torque_covered += std::abs(tool.torque_average.mean + 0.1) < 2.262 * tool.torque_average.uncertainty ? 1 : 0;
  }
  EXPECT_NEAR(static_cast<double>(covered) / runs, 0.95, 0.02);
  EXPECT_NEAR(static_cast<double>(torque_covered) / runs, 0.95, 0.02);
}

TEST(ReadingAverage, IsOfTheLastSecond) {
  ReadingAverage average;
  tools::ToolState tool;
  for (int i = 0; i <= 300; ++i) average.add(0.01 * i, tool = carrying(i < 170 ? 1.0 : 2.0, i < 170 ? 0.0 : 0.5));
  EXPECT_NEAR(tool.weight_average.mean, 2.0, 1e-12);
  EXPECT_NEAR(tool.torque_average.mean, 0.5, 1e-12);
  EXPECT_LT(tool.weight_average.uncertainty, 1e-12);
  EXPECT_EQ(tool.weight, 2.0);
}

/// What is shown is another state of the same tool, predicted from what was read.
TEST(ReadingAverage, FillsInAToolThatCarriesTheSame) {
  ReadingAverage average;
  tools::ToolState tool;
  for (int i = 0; i <= 60; ++i) average.add(0.02 * i, tool = carrying(2.0, 0.5));
  tools::ToolState shown = carrying(2.7, 0.9);
  average.fill_in(shown);
  EXPECT_EQ(shown.weight_average.mean, tool.weight_average.mean);
  EXPECT_EQ(shown.weight_average.uncertainty, tool.weight_average.uncertainty);
  EXPECT_EQ(shown.torque_average.mean, tool.torque_average.mean);
  for (const std::string other : {"ball", ""}) {
    average.fill_in(shown = carrying(2.7, 0.9, other));
    EXPECT_EQ(shown.weight_average.mean, 2.7);
    EXPECT_TRUE(std::isinf(shown.torque_average.uncertainty));
  }
}

TEST(ReadingAverage, RestartsWithAnotherObjectAndWhenTimeGoesBack) {
  ReadingAverage average;
  tools::ToolState tool;
  const auto at = [&](double t, double weight, const std::string& object) {
    average.add(t, tool = carrying(weight, 0.0, object));
    return tool.weight_average;
  };
  for (int i = 0; i <= 100; ++i) at(0.02 * i, 5.0, "box");
  EXPECT_EQ(at(2.02, 1.0, "ball").mean, 1.0);
  EXPECT_TRUE(std::isinf(tool.weight_average.uncertainty));
  for (int i = 0; i <= 100; ++i) at(2.04 + 0.02 * i, 1.0, "ball");
  EXPECT_EQ(at(0.5, 4.0, "ball").mean, 4.0);
  EXPECT_EQ(at(0.52, 0.0, "").mean, 0.0);
}

}  // namespace
}  // namespace spring_workbench::instruments::reading_average_test
