// The first row of every reference trajectory is the rigid-body image of the handle's first state, at zero strain: it
// checks the rule at the first sample against an independent solver.
#include <gtest/gtest.h>

#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "spring_workbench/motion/pose_track.h"

namespace spring_workbench::motion {
namespace {

struct Reference {
  std::string csv;
  std::string motion;
  double length;  // [m] fork
  Vector3d p_OE;  // [m] tip in the object, axes alike
};

std::vector<PoseSample> read_samples(const std::string& path) {
  std::ifstream file(path);
  std::vector<PoseSample> samples;
  for (std::string line; std::getline(file, line);) {
    if (line.empty() || line[0] == '#') continue;
    std::istringstream in(line);
    double t, x, y, z, qx, qy, qz, qw;
    in >> t >> x >> y >> z >> qx >> qy >> qz >> qw;
    samples.push_back({t, make_transform(Quaterniond(qw, qx, qy, qz), Vector3d(x, y, z))});
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

TEST(ReferenceMotion, FirstRowIsTheHandlesMotion) {
  const std::string folder = std::string(SPRING_WORKBENCH_SHARED_DIR) + "/reference/";
  if (!std::ifstream(folder + "soft_6dof.csv")) GTEST_SKIP() << "no reference trajectories in " << folder;
  const Reference references[] = {
      {"soft_6dof", "motion_vicon", 0.2, {0.03, 0.02, -0.05}},
      {"heavy_large_bend", "motion_vicon", 0.2, {0.02, 0.0, -0.06}},
      {"stylus", "motion_stylus", 0.2, {0.03, 0.02, -0.05}},
      {"stiff_6dof", "motion_vicon_1s", 0.15, {0.01, 0.01, -0.03}},
  };
  for (const Reference& reference : references) {
    SCOPED_TRACE(reference.csv);
    PoseTrack track;
    for (const PoseSample& sample : read_samples(folder + reference.motion + ".tum")) track.push(sample);
    const MotionState handle = track.segment(0.0).at(0.0);
    const std::vector<double> row = first_row(folder + reference.csv + ".csv");
    ASSERT_GE(row.size(), 15u);
    const Vector3d p_HO_W = handle.X.linear() * (Vector3d(0.0, 0.0, reference.length) - reference.p_OE);
    const Vector3d p_WO = handle.X.translation() + p_HO_W;
    const Vector3d v_WO = handle.velocity.linear + handle.velocity.angular.cross(p_HO_W);
    const Quaterniond q_WO(row[8], row[5], row[6], row[7]);
    EXPECT_LT((p_WO - Vector3d(row[2], row[3], row[4])).norm(), 2e-12);
    EXPECT_LT((handle.X.linear() - q_WO.normalized().toRotationMatrix()).norm(), 1e-11);
    // The file has nine digits.
    EXPECT_LT((v_WO - Vector3d(row[9], row[10], row[11])).norm(), 2e-10);
    EXPECT_LT((handle.velocity.angular - Vector3d(row[12], row[13], row[14])).norm(), 2e-10);
  }
}

TEST(ReferenceMotion, PassesThroughTheRecordedSamples) {
  const std::string path = std::string(SPRING_WORKBENCH_SHARED_DIR) + "/reference/motion_stylus.tum";
  const std::vector<PoseSample> samples = read_samples(path);
  if (samples.empty()) GTEST_SKIP() << "no " << path;
  PoseTrack track(1.0);
  for (const PoseSample& sample : samples) ASSERT_TRUE(track.push(sample));
  for (const PoseSample& sample : samples) {
    const RigidTransform X = track.segment(sample.t).at(sample.t).X;
    EXPECT_LT((X.matrix() - sample.X.matrix()).norm(), 1e-14);
  }
}

}  // namespace
}  // namespace spring_workbench::motion
