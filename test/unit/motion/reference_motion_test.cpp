// The first row of every reference trajectory is the rigid-body image of the handle's first state, at zero strain: it
// checks the rule at the first sample against an independent solver.
#include <gtest/gtest.h>

#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "spring_workbench/motion/pose_track.h"
#include "support/paths.h"

namespace spring_workbench::motion::reference_motion_test {
namespace {

struct Reference {
  std::string csv;
  std::string motion;
  double length;        // [m] fork
  RigidTransform X_OE;  // tip in the object
};

const std::string data = test_support::checkout("test/data/reference/");

std::vector<PoseSample> read_samples(const std::string& path) {
  std::ifstream file(path);
  std::vector<PoseSample> samples;
  for (std::string line; std::getline(file, line);) {
    if (line.empty() || line[0] == '#') continue;
    std::istringstream in(line);
    double t, x, y, z, qx, qy, qz, qw;
    in >> t >> x >> y >> z >> qx >> qy >> qz >> qw;
    samples.push_back({t, make_transform(Vector3d(x, y, z), Quaterniond(qw, qx, qy, qz))});
  }
  return samples;
}

std::vector<double> first_row(const std::string& path) {
  std::ifstream file(path);
  std::string line, cell;
  std::getline(file, line);
  std::getline(file, line);
  std::istringstream in(line);
  std::vector<double> row;
  while (std::getline(in, cell, ',')) row.push_back(cell == "object" ? 0.0 : std::stod(cell));
  return row;
}

RigidTransform at(double x, double y, double z) { return make_transform({x, y, z}, Quaterniond::Identity()); }

void expect_first_row_is_the_handles_motion(const std::string& folder, const Reference& reference) {
  SCOPED_TRACE(reference.csv);
  PoseTrack track;
  for (const PoseSample& sample : read_samples(folder + reference.motion + ".tum")) track.push(sample);
  const MotionState handle = track.segment(0.0).at(0.0);
  const std::vector<double> row = first_row(folder + reference.csv + ".csv");
  ASSERT_GE(row.size(), 15u);
  const RigidTransform X_HO = at(0.0, 0.0, reference.length) * reference.X_OE.inverse(Eigen::Isometry);
  const RigidTransform X_WO = handle.X * X_HO;
  const Vector3d v_WO = handle.velocity.linear + handle.velocity.angular.cross(handle.X.linear() * X_HO.translation());
  const Quaterniond q_WO(row[8], row[5], row[6], row[7]);
  EXPECT_LT((X_WO.translation() - Vector3d(row[2], row[3], row[4])).norm(), 2e-12);
  EXPECT_LT((X_WO.linear() - q_WO.normalized().toRotationMatrix()).norm(), 1e-11);
  // The file has nine digits; speeds are below 4.
  EXPECT_LT((v_WO - Vector3d(row[9], row[10], row[11])).norm(), 1e-8);
  EXPECT_LT((handle.velocity.angular - Vector3d(row[12], row[13], row[14])).norm(), 1e-8);
}

void expect_to_pass_through_the_samples(const std::string& path) {
  const std::vector<PoseSample> samples = read_samples(path);
  ASSERT_FALSE(samples.empty()) << path;
  PoseTrack track(1.0);
  for (const PoseSample& sample : samples) ASSERT_TRUE(track.push(sample));
  for (const PoseSample& sample : samples) {
    const RigidTransform X = track.segment(sample.t).at(sample.t).X;
    EXPECT_LT((X.matrix() - sample.X.matrix()).norm(), 1e-14);
  }
}

TEST(ReferenceMotion, FirstRowIsTheHandlesMotion) {
  const RigidTransform turned = make_transform({0.02, 0.03, -0.07}, Quaterniond(0.974679434, 0.1, 0.0, 0.2));
  const Reference references[] = {
      {"swing_soft", "motion_swing", 0.2, at(0.03, 0.02, -0.05)},
      {"reach_constant_shape", "motion_reach", 0.2, at(0.03, 0.02, -0.05)},
      {"reach_heavy", "motion_reach", 0.25, turned},
      {"reach_stiff", "motion_reach_1s", 0.15, at(0.01, 0.01, -0.03)},
  };
  for (const Reference& reference : references) expect_first_row_is_the_handles_motion(data, reference);
}

TEST(ReferenceMotion, FirstRowIsTheRecordedHandlesMotion) {
  const std::string folder = test_support::extra_data("reference/");
  if (folder.empty()) GTEST_SKIP() << "SPRING_WORKBENCH_TEST_DATA is not given";
  const Reference references[] = {
      {"soft_6dof", "motion_vicon", 0.2, at(0.03, 0.02, -0.05)},
      {"heavy_large_bend", "motion_vicon", 0.2, at(0.02, 0.0, -0.06)},
      {"stylus", "motion_stylus", 0.2, at(0.03, 0.02, -0.05)},
      {"stiff_6dof", "motion_vicon_1s", 0.15, at(0.01, 0.01, -0.03)},
  };
  for (const Reference& reference : references) expect_first_row_is_the_handles_motion(folder, reference);
}

TEST(ReferenceMotion, PassesThroughTheSamples) {
  for (const char* name : {"motion_swing.tum", "motion_reach.tum"}) expect_to_pass_through_the_samples(data + name);
}

TEST(ReferenceMotion, PassesThroughTheRecordedSamples) {
  const std::string path = test_support::extra_data("reference/motion_stylus.tum");
  if (path.empty()) GTEST_SKIP() << "SPRING_WORKBENCH_TEST_DATA is not given";
  expect_to_pass_through_the_samples(path);
}

}  // namespace
}  // namespace spring_workbench::motion::reference_motion_test
