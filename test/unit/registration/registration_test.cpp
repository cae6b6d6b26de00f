#include "spring_workbench/registration/registration.h"

#include <gtest/gtest.h>

#include <cmath>
#include <iostream>
#include <numeric>
#include <random>

#include "spring_workbench/math/so3.h"
#include "spring_workbench/motion_files/motion_file.h"
#include "spring_workbench/validation/input_error.h"

namespace spring_workbench::registration::registration_test {
namespace {

using namespace std::string_literals;

const std::vector<Vector3d> kPlaces{{0, 0, 0}, {0.4, 0, 0}, {0.1, 0.3, 0}, {0.35, 0.25, 0.1}, {0.0, 0.15, 0.2}};

RigidTransform some_pose(unsigned seed) {
  srand(seed);
  return make_transform(Vector3d::Random(), Quaterniond::UnitRandom());
}

/// Touches of the landmarks as measured by a tracker at X_BT.
std::vector<Landmark> touched(const std::vector<Vector3d>& places, const RigidTransform& X_BT, double noise,
                              std::mt19937& random) {
  std::normal_distribution<double> error(0.0, 1.0);
  std::vector<Landmark> landmarks;
  for (const Vector3d& p : places) {
    const Vector3d e(error(random), error(random), error(random));
    landmarks.push_back({"abcdefgh"s.substr(landmarks.size(), 1), p, X_BT.inverse() * p + noise * e});
  }
  return landmarks;
}

TEST(Registration, ExactTouchesGiveTheExactPose) {
  std::mt19937 random(1);
  for (unsigned seed = 0; seed < 50; ++seed) {
    const RigidTransform X_BT = some_pose(seed);
    const Registration found = register_tracker(touched(kPlaces, X_BT, 0.0, random), 1e-3);
    EXPECT_LT((found.X_BT.matrix() - X_BT.matrix()).norm(), 1e-12);
    EXPECT_LT(found.rms, 1e-12);
  }
}

TEST(Registration, ThePoseErrorAgreesWithTheory) {
  constexpr double sigma = 1e-3;  // [m]
  constexpr int runs = 4000;
  std::mt19937 random(2);
  const Vector3d middle = std::accumulate(kPlaces.begin(), kPlaces.end(), Vector3d(0, 0, 0)) / 5.0;
  double position = 0.0, angle = 0.0, reported_position = 0.0, reported_angle = 0.0, reported_touch = 0.0;
  for (int run = 0; run < runs; ++run) {
    const RigidTransform X_BT = some_pose(static_cast<unsigned>(run));
    const Registration found = register_tracker(touched(kPlaces, X_BT, sigma, random), 0.02);
    const RigidTransform E = found.X_BT * X_BT.inverse();
    position += (E * middle - middle).squaredNorm() / runs;
    angle += math::log_so3(E.linear()).squaredNorm() / runs;
    reported_position += found.position_error * found.position_error / runs;
    reported_angle += found.angle_error * found.angle_error / runs;
    reported_touch += found.touch_error * found.touch_error / runs;
  }
  std::cout << "1 mm touches of 5 landmarks: position off by " << 1e3 * std::sqrt(position) << " mm (said "
            << 1e3 * std::sqrt(reported_position) << "), angle by " << 1e3 * std::sqrt(angle) << " mrad (said "
            << 1e3 * std::sqrt(reported_angle) << ")\n";
  EXPECT_NEAR(std::sqrt(position), sigma * std::sqrt(3.0 / 5.0), 0.03 * sigma);  // theory, in closed form
  EXPECT_NEAR(std::sqrt(reported_touch), sigma, 0.03 * sigma);
  EXPECT_NEAR(std::sqrt(position / reported_position), 1.0, 0.04);
  EXPECT_NEAR(std::sqrt(angle / reported_angle), 1.0, 0.04);
}

TEST(Registration, EveryWrongOrderIsRefused) {
  std::mt19937 random(3);
  std::vector<std::size_t> order{0, 1, 2, 3, 4};
  const auto right = touched(kPlaces, some_pose(3), 1e-3, random);
  EXPECT_NO_THROW(register_tracker(right, 0.01));
  int refused = 0;
  while (std::next_permutation(order.begin(), order.end())) {
    auto wrong = right;
    for (std::size_t i = 0; i < order.size(); ++i) wrong[i].p_T = right[order[i]].p_T;
    EXPECT_THROW(register_tracker(wrong, 0.01), validation::InputError);
    ++refused;
  }
  EXPECT_EQ(refused, 119);
}

void expect_refused(const std::vector<Landmark>& landmarks, const std::string& word) {
  try {
    register_tracker(landmarks, 0.01);
    FAIL() << "not refused: " << word;
  } catch (const validation::InputError& e) {
    EXPECT_NE(std::string(e.what()).find(word), std::string::npos) << e.what();
    EXPECT_EQ(std::string(e.what()).find('\n'), std::string::npos);
  }
}

TEST(Registration, LandmarksThatDoNotDetermineThePoseAreRefused) {
  std::mt19937 random(4);
  const RigidTransform X = some_pose(4);
  expect_refused(touched({{0, 0, 0}, {1, 0, 0}}, X, 0, random), "at least 3");
  expect_refused(touched({{0, 0, 0}, {0.1, 0, 0}, {0.5, 0.001, 0}, {0.7, 0, 0}}, X, 0, random), "off a common line");
  expect_refused(touched({{0, 0, 0}, {0.2, 0, 0}, {0.2, 0.2, 0}, {0, 0.2, 0}}, X, 1e-3, random), "too symmetric");
  auto doubled = touched(kPlaces, X, 0, random);
  doubled[1].name = doubled[0].name;
  expect_refused(doubled, "named twice");
  auto swapped = touched(kPlaces, X, 1e-4, random);
  std::swap(swapped[0].p_T, swapped[1].p_T);
  expect_refused(swapped, "order b, a, c, d, e");
}

/// Poses of a stylus that turns about its tip.
std::vector<RigidTransform> pivoted(const Vector3d& tip, double reach, double noise, std::mt19937& random) {
  std::normal_distribution<double> error(0.0, 1.0);
  const Vector3d rest(0.3, -0.2, 0.1);
  std::vector<RigidTransform> poses;
  for (int k = 0; k < 300; ++k) {
    const Matrix3d R = math::exp_so3(reach * Vector3d(std::sin(0.13 * k), std::cos(0.071 * k), std::sin(0.029 * k)));
    const Vector3d e(error(random), error(random), error(random));
    poses.push_back(make_transform(rest - R * tip + noise * e, Quaterniond(R)));
  }
  return poses;
}

TEST(PivotCalibration, FindsTheTip) {
  std::mt19937 random(5);
  const Vector3d tip(0.01, -0.02, 0.15);
  const PivotCalibration exact = calibrate_tip(pivoted(tip, 0.5, 0.0, random), 1e-3);
  EXPECT_LT((exact.p_ST - tip).norm(), 1e-12);
  EXPECT_LT(exact.rms, 1e-12);
  const PivotCalibration noisy = calibrate_tip(pivoted(tip, 0.5, 1e-3, random), 5e-3);
  EXPECT_LT((noisy.p_ST - tip).norm(), 1e-3);
  EXPECT_NEAR(noisy.rms, std::sqrt(3.0) * 1e-3, 1e-4);
}

TEST(PivotCalibration, RefusesTooLittleTurningAndASlip) {
  std::mt19937 random(6);
  const Vector3d tip(0.0, 0.0, 0.15);
  EXPECT_THROW(calibrate_tip(pivoted(tip, 0.05, 0.0, random), 1e-3), validation::InputError);
  EXPECT_THROW(calibrate_tip(pivoted(tip, 0.5, 5e-3, random), 1e-3), validation::InputError);
}

TEST(PivotCalibration, TakesTenPosesAndNoFewer) {
  std::mt19937 random(6);
  const std::vector<RigidTransform> all = pivoted(Vector3d(0.0, 0.0, 0.15), 0.5, 0.0, random);
  std::vector<RigidTransform> few;
  for (std::size_t k = 0; k < all.size(); k += 30) few.push_back(all[k]);
  ASSERT_EQ(few.size(), 10u);
  EXPECT_NO_THROW(calibrate_tip(few, 1e-3));
  few.pop_back();
  EXPECT_THROW(calibrate_tip(few, 1e-3), validation::InputError);
}

}  // namespace
}  // namespace spring_workbench::registration::registration_test
