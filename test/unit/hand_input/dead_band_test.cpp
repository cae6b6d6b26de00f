#include "spring_workbench/hand_input/dead_band.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "spring_workbench/hand_input/input_filter.h"
#include "spring_workbench/math/so3.h"
#include "support/bench_scenes.h"

namespace spring_workbench::hand_input::dead_band_test {
namespace {

constexpr double kBand = 5e-4, kAngleBand = 2e-3, kInterval = 0.02;

InputSettings with_band(double distance, double angle) {
  InputSettings settings;
  settings.dead_band_distance = distance;
  settings.dead_band_angle = angle;
  return settings;
}

double angle_between(const RigidTransform& a, const RigidTransform& b) { return math::turn_between(a, b).norm(); }
double distance_between(const RigidTransform& a, const RigidTransform& b) {
  return (a.translation() - b.translation()).norm();
}

/// A hand that rests, moves quickly and slowly, and rests, trembling all the time.
RigidTransform trembling(double t, double noise, double angle_noise, std::mt19937& random) {
  std::normal_distribution<double> normal(0.0, 1.0);
  const auto wobble = [&](double size) {
    return Vector3d(size * Vector3d(normal(random), normal(random), normal(random)));
  };
  const double way = t < 2.0 ? 0.0 : t < 4.0 ? 0.5 * (1.0 - std::cos(0.5 * M_PI * (t - 2.0))) : 1.0;
  RigidTransform X = pointing_down(Vector3d(0.2 * way, 0.0, 0.7) + wobble(noise));
  X.linear() = X.linear() * math::exp_so3(Vector3d(0.3 * way, 0.0, 0.8 * way) + wobble(angle_noise));
  return X;
}

/// The followed pose is never farther from the tracked hand than the band, and its step is at most that of the hand
/// plus the decrease of the distance.
TEST(DeadBand, FollowsWithinTheBandAndNeverJumps) {
  std::mt19937 random(5);
  std::normal_distribution<double> normal(0.0, 1.0);
  DeadBand band(with_band(kBand, kAngleBand));
  RigidTransform raw = RigidTransform::Identity(), before = raw, followed_before = raw;
  const double shrinks = 1.0 - std::exp(-kInterval / 0.1);
  int rested = 0;
  for (int k = 0; k < 5000; ++k) {
    const double size = k % 100 < 50 ? 1e-5 : std::pow(10.0, -5.0 + 3.0 * (k % 50) / 50.0);
    raw.translation() += size * Vector3d(normal(random), normal(random), normal(random));
    raw.linear() = raw.linear() * math::exp_so3(3.0 * size * Vector3d(normal(random), normal(random), normal(random)));
    raw.linear() = Quaterniond(raw.linear()).normalized().toRotationMatrix();
    const RigidTransform followed = band.filter({k * kInterval, raw}).X;
    EXPECT_LE(distance_between(followed, raw), kBand * (1.0 + 1e-9));
    EXPECT_LE(angle_between(followed, raw), kAngleBand * (1.0 + 1e-9));
    if (k > 0) {
      EXPECT_LE(distance_between(followed, followed_before), distance_between(raw, before) + shrinks * kBand);
      EXPECT_LE(angle_between(followed, followed_before), angle_between(raw, before) + shrinks * kAngleBand + 1e-12);
    }
    rested += followed.matrix() == followed_before.matrix() ? 1 : 0;
    before = raw;
    followed_before = followed;
  }
  EXPECT_GT(rested, 500);
  EXPECT_LT(rested, 3000);
}

/// A hand in steady motion is eventually followed exactly, not at the band's distance.
TEST(DeadBand, ForgetsItsPlayDuringMotion) {
  DeadBand band(with_band(kBand, kAngleBand));
  RigidTransform raw = RigidTransform::Identity();
  for (int k = 0; k < 200; ++k) {
    if (k > 50) raw.translation().x() += 2e-3;
    const RigidTransform followed = band.filter({k * kInterval, raw}).X;
    if (k <= 50) continue;
    EXPECT_NEAR(distance_between(followed, raw), kBand * std::exp(-(k - 50) * kInterval / 0.1), 1e-9);
  }
}

TEST(DeadBand, WithoutABandEverySamplePassesBitIdentically) {
  std::mt19937 random(6);
  DeadBand band(with_band(0.0, 0.0));
  for (int k = 0; k < 200; ++k) {
    const RigidTransform X = trembling(kInterval * k, 1e-17, 1e-17, random);
    EXPECT_EQ(band.filter({kInterval * k, X}).X.matrix(), X.matrix());
  }
}

TEST(DeadBand, AfterARestartTheNextSampleIsFollowedExactly) {
  DeadBand band(with_band(kBand, kAngleBand));
  const RigidTransform a = pointing_down(Vector3d(0.0, 0.0, 0.5)), b = pointing_down(Vector3d(1e-4, 0.0, 0.5));
  for (const double t : {0.0, 0.2, 0.4}) EXPECT_EQ(band.filter({t, a}).X.matrix(), a.matrix());
  EXPECT_EQ(band.filter({1.0, b}).X.matrix(), a.matrix());
  band.restart();
  EXPECT_EQ(band.filter({2.0, b}).X.matrix(), b.matrix());
}

/// The object of a trembling hand sleeps while the hand rests, before and after a motion, and ends where a steady hand
/// leaves it, to within the band.
TEST(DeadBand, WhatATremblingHandHoldsSleepsWhileTheHandRests) {
  for (const bool banded : {false, true}) {
    std::mt19937 random(7);
    const scene::Scene scene =
        scene_of({box("box", Vector3d(0.1, 0.06, 0.04), 1.0, Vector3d(0.0, 0.0, 0.5))}, scene::ContactMode::none);
    simulation::SimulationSettings settings;
    settings.grasp.object = "box";
    simulation::Simulation simulation(scene, settings);
    InputFilter filter(simulation, with_band(banded ? kBand : 0.0, kAngleBand));
    for (int k = 0; k <= 300; ++k) {
      const double t = kInterval * k;
      filter.push_stylus({t, trembling(t, 8e-5, 1e-4, random)});
      if (k < 2) continue;
      filter.advance_to(t - 2.0 * kInterval);
      const bool rested = (t > 1.7 && t < 2.0) || t > 5.5;
      const bool moves = t > 2.2 && t < 4.0;
      if (!rested && !moves) continue;
      EXPECT_EQ(simulation.objects()[0].asleep, banded && rested) << t;
    }
  }
}

}  // namespace
}  // namespace spring_workbench::hand_input::dead_band_test
