#include "spring_workbench/instruments/material_estimate.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

namespace spring_workbench::instruments::material_estimate_test {
namespace {

constexpr double kInterval = 0.02, kNoise = 5e-4;

/// A hand presses a probe into a spring K with a parallel damper C, back and forth as people do: depth d(t), F = K d +
/// C ḋ; the tracker adds noise to the path.
struct Touch {
  double stiffness, damping, depth, duration, rate;

  double d(double t) const { return 0.5 * depth * (1.0 - std::cos(2.0 * M_PI * rate * t)); }
  double d_dot(double t) const { return M_PI * rate * depth * std::sin(2.0 * M_PI * rate * t); }
  double force(double t) const { return stiffness * d(t) + damping * d_dot(t); }
};

MaterialEstimate estimate_of(const Touch& touch, double probe, double noise, std::mt19937& random,
                             double own_damping = 0.0) {
  std::normal_distribution<double> normal(0.0, 1.0);
  MaterialEstimate estimate(probe, own_damping);
  for (double t = 0.0; t < touch.duration; t += kInterval) {
    if (touch.force(t) > 0.0) estimate.add(t, 0.3 + touch.d(t) + noise * normal(random), touch.force(t));
  }
  return estimate;
}

bool covers(const Estimate& estimate, double truth) { return estimate.low <= truth && truth <= estimate.high; }

TEST(MaterialEstimate, WithoutNoiseItIsExact) {
  std::mt19937 random(1);
  for (const double material : {1e2, 1e4, 1e6}) {
    const double probe = 5e3, touch = 1.0 / (1.0 / probe + 1.0 / material);
    const auto reading = estimate_of({touch, 0.0, 0.02, 2.0, 0.5}, probe, 0.0, random).reading();
    ASSERT_TRUE(reading);
    EXPECT_NEAR(reading->touch.value, touch, 1e-9 * touch);
    EXPECT_NEAR(reading->material.value, material, 1e-6 * material);
    EXPECT_NEAR(reading->damping.value, 0.0, 1e-6 * touch);
  }
}

TEST(MaterialEstimate, IntervalsHaveTheirNominalCoverage) {
  std::mt19937 random(2);
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  int stiffness_covered = 0, damping_covered = 0;
  constexpr int touches = 2000;
  for (int i = 0; i < touches; ++i) {
    const double material = std::pow(10.0, 2.0 + 4.0 * uniform(random)),
                 probe = std::pow(10.0, 3.0 + 3.0 * uniform(random));
    const double stiffness = 1.0 / (1.0 / probe + 1.0 / material);
    const double damping = i % 2 == 0 ? 0.0 : stiffness * 0.1 * uniform(random);
    const Touch touch{stiffness, damping, 0.01 + 0.04 * uniform(random), 1.0 + 3.0 * uniform(random),
                      0.3 + 0.3 * uniform(random)};
    const auto reading = estimate_of(touch, probe, kNoise, random).reading();
    ASSERT_TRUE(reading) << i;
    stiffness_covered += covers(reading->material, material) ? 1 : 0;
    damping_covered += covers(reading->damping, damping) ? 1 : 0;
  }
  EXPECT_NEAR(static_cast<double>(stiffness_covered) / touches, 0.95, 0.02);
  EXPECT_NEAR(static_cast<double>(damping_covered) / touches, 0.95, 0.02);
}

/// Of the material: what is left of the touch's damping beyond the probe's own damper.
TEST(MaterialEstimate, FindsTheTrueDamping) {
  const Touch touch{2e3, 400.0, 0.05, 4.0, 0.4};
  for (const double own : {0.0, 150.0}) {
    std::mt19937 random(3);
    const auto reading = estimate_of(touch, 1e5, kNoise, random, own).reading();
    ASSERT_TRUE(reading);
    EXPECT_NEAR(reading->damping.value, touch.damping - own, 0.05 * touch.damping);
    EXPECT_NEAR(reading->touch.value, touch.stiffness, 0.02 * touch.stiffness);
    EXPECT_GT(reading->damping.low, 0.0);
  }
}

/// A touch that starts with an impact on a damper: there is a force before the spring is compressed.
TEST(MaterialEstimate, AnImpactAtTheBeginningDoesNotBiasIt) {
  const double stiffness = 2e3, damping = 90.0;
  MaterialEstimate estimate(2e3);
  for (int i = 0; i < 30; ++i) {
    const double t = 0.01 + kInterval * i, d = 0.03 * std::sin(2.5 * t), d_dot = 0.075 * std::cos(2.5 * t);
    estimate.add(t, 0.1 + d, stiffness * d + damping * d_dot);
  }
  ASSERT_TRUE(estimate.reading());
  EXPECT_NEAR(estimate.reading()->touch.value, stiffness, 1e-3 * stiffness);
  EXPECT_NEAR(estimate.reading()->damping.value, damping, 0.03 * damping);
}

TEST(MaterialEstimate, HasNoReadingBeforeEnoughData) {
  MaterialEstimate estimate(1e3);
  EXPECT_FALSE(estimate.reading());
  for (int i = 0; i < 50; ++i) {  // a constant force says nothing of a spring
    estimate.add(kInterval * i, 0.1, 5.0);
    EXPECT_FALSE(estimate.reading());
    EXPECT_TRUE(estimate.curve().empty());
  }
  MaterialEstimate other(1e3);
  for (int i = 0; i < 8; ++i) {
    EXPECT_EQ(other.reading().has_value(), i >= 6) << i;
    other.add(kInterval * i, 1e-3 * i * i, 1.0 * i * i);
  }
}

TEST(MaterialEstimate, ForgetsTheOldestSamples) {
  std::mt19937 random(4);
  const Touch touch{1e3, 0.0, 0.03, 1e3, 0.4};
  MaterialEstimate estimate(1e5);
  for (int i = 1; i <= 1200; ++i) {
    const double t = kInterval * i, k = i <= 600 ? 1.0 : 2.0;  // the material hardens
    estimate.add(t, touch.d(t), k * touch.force(t));
  }
  EXPECT_EQ(estimate.curve().size(), 500u);
  ASSERT_TRUE(estimate.reading());
  EXPECT_NEAR(estimate.reading()->touch.value, 2e3, 1e-3);
}

TEST(MaterialEstimate, TheCurveIsForceOverDepth) {
  std::mt19937 random(5);
  const Touch touch{1e3, 0.0, 0.03, 2.0, 0.5};
  for (const auto& point : estimate_of(touch, 1e5, 0.0, random).curve()) {
    EXPECT_NEAR(point.force, touch.stiffness * point.depth, 1e-9);
  }
}

}  // namespace
}  // namespace spring_workbench::instruments::material_estimate_test
