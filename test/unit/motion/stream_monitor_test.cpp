#include "spring_workbench/motion/stream_monitor.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace spring_workbench::motion::stream_monitor_test {
namespace {

TEST(StreamMonitor, ReportsRateJitterGapsAndAge) {
  std::mt19937 random(2);
  std::normal_distribution<double> noise(0.0, 1e-3);
  StreamMonitor monitor(0.5);
  double age = 0.0;
  for (int k = 0; k < 5000; ++k) {
    const double t = k * 0.01 + (k >= 2500 ? 2.0 : 0.0);
    age = 0.02 + noise(random);
    monitor.sample(t, t + age);
  }
  const StreamFigures& figures = monitor.figures();
  EXPECT_EQ(figures.samples, 5000u);
  EXPECT_NEAR(figures.interval, 0.01, 1e-9);
  EXPECT_LT(figures.stamp_jitter, 1e-9);
  EXPECT_NEAR(figures.receipt_jitter, std::sqrt(2.0) * 1e-3, 0.4e-3);  // of some fifty samples
  EXPECT_NEAR(figures.longest_gap, 2.01, 1e-9);
  EXPECT_NEAR(figures.age, age, 1e-12);
}

}  // namespace
}  // namespace spring_workbench::motion::stream_monitor_test
