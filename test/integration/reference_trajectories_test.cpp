// `replay` against the trajectories of an independent solver: long double, rod integrated over 24 sections, adaptive
// Runge-Kutta-Fehlberg 7(8). Those on hands by formula are in test/data; those on recorded hands come from outside.
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iostream>
#include <sstream>
#include <string>
#include <vector>

#include "spring_workbench/math/rigid_transform.h"
#include "support/paths.h"
#include "support/temporary_folder.h"

namespace spring_workbench {
namespace {

struct Body {
  double mass;       // [kg]
  Vector3d inertia;  // [kg·m²] diagonal
};
const Body kSoft = {1.0, {0.004, 0.006, 0.005}};
const Body kHeavy = {3.0, {0.02, 0.03, 0.025}};
const Body kLight = {0.3, {2e-4, 3e-4, 4e-4}};
const Body kHeaviest = {4.0, {0.03, 0.05, 0.04}};

struct Case {
  std::string name;
  std::string motion;
  Body body;
  std::string settings;
  double until;                       // [s]
  double one_step_per_sample = 1e-5;  // [m] limit; of angles [rad]: ten times as much, in all three
  double millisecond = 1e-5;          // [m]
  double small_step = 1e-7;           // [m]
};

std::ostream& operator<<(std::ostream& out, const Case& one) { return out << one.name; }

std::string fork(const std::string& length, const std::string& stretch, const std::string& bend,
                 const std::string& torsion, const std::string& tip) {
  return "fork: {length: " + length + ", stiffness: {stretch: " + stretch + ", bend: " + bend +
         ", torsion: " + torsion + "}}\ngrasp.tip_in_object: " + tip + "\n";
}

const std::string kSoftFork = fork("0.2", "2000", "500", "5", "0.03 0.02 -0.05 0 0 0 1");
const std::string kStiffFork = fork("0.15", "2e5", "5e4", "200", "0.01 0.01 -0.03 0 0 0 1");

std::string damped(const std::string& stretch, const std::string& bend, const std::string& torsion) {
  return kSoftFork + "fork.damping: {stretch: " + stretch + ", bend: " + bend + ", torsion: " + torsion + "}\n";
}

std::vector<Case> by_formula() {
  const std::string bend_only = kSoftFork + "fork.dofs: {stretch: false, torsion: false}\n";
  const std::string heavy = fork("0.25", "1200", "180", "4", "0.02 0.03 -0.07 0.1 0 0.2 0.974679434");
  return {
      {"swing_soft", "motion_swing", kSoft, kSoftFork, 3.0, 5e-5, 1e-8, 2e-9},
      {"swing_undamped", "motion_swing", kSoft, damped("0", "0", "0"), 3.0, 2e-4, 1e-7, 4e-8},
      {"swing_bend_only", "motion_swing", kSoft, bend_only, 3.0, 2e-5, 1e-8, 2e-9},
      {"reach_constant_shape", "motion_reach", kSoft, kSoftFork + "shape: constant\n", 3.0, 1e-9, 1e-11, 2e-12},
      {"reach_mixed_damping", "motion_reach", kSoft, damped("0.3", "2", "0.7"), 3.0, 5e-6, 1e-8, 2e-9},
      {"reach_heavy", "motion_reach", kHeaviest, heavy, 3.0, 1e-7, 1e-7, 4e-8},
      {"reach_stiff", "motion_reach_1s", kLight, kStiffFork, 1.0, 1e-9, 1e-11, 2e-12},
  };
}

std::vector<Case> recorded() {
  return {
      {"soft_6dof", "motion_vicon", kSoft, kSoftFork, 8.0},
      {"soft_constant_shape", "motion_vicon", kSoft, kSoftFork + "shape: constant\n", 8.0},
      {"torsion_only", "motion_vicon", kSoft, kSoftFork + "fork.dofs: {stretch: false, bend: false}\n", 8.0},
      {"bend_only", "motion_vicon", kSoft, kSoftFork + "fork.dofs: {stretch: false, torsion: false}\n", 8.0},
      {"stretch_only", "motion_vicon", kSoft, kSoftFork + "fork.dofs: {bend: false, torsion: false}\n", 8.0},
      {"underdamped", "motion_vicon", kSoft, damped("0.1", "0.1", "0.1"), 8.0},
      {"heavy_large_bend", "motion_vicon", kHeavy, fork("0.2", "1500", "150", "3", "0.02 0 -0.06 0 0 0 1"), 8.0},
      {"stylus", "motion_stylus", kSoft, kSoftFork, 8.0},
      {"stiff_6dof", "motion_vicon_1s", kLight, kStiffFork, 1.0},
  };
}

std::string scene_of(const Body& body) {
  std::ostringstream urdf;
  urdf << "<robot name=\"reference\"><link name=\"world\"/><link name=\"object\"><inertial><mass value=\"" << body.mass
       << "\"/><inertia ixx=\"" << body.inertia.x() << "\" ixy=\"0\" ixz=\"0\" iyy=\"" << body.inertia.y()
       << "\" iyz=\"0\" izz=\"" << body.inertia.z()
       << "\"/></inertial></link><joint name=\"free\" type=\"floating\"><parent link=\"world\"/>"
          "<child link=\"object\"/></joint></robot>\n";
  return urdf.str();
}

/// One object at one time; what follows the quaternion is not compared.
struct Row {
  double t;
  RigidTransform X_WO;
};

std::vector<Row> read_rows(const std::string& path) {
  std::ifstream file(path);
  std::vector<Row> rows;
  std::string line, cell;
  std::getline(file, line);
  while (std::getline(file, line)) {
    std::istringstream in(line);
    std::vector<double> v;
    for (int column = 0; column < 9 && std::getline(in, cell, ','); ++column) {
      if (column != 1) v.push_back(std::stod(cell));
    }
    if (v.size() == 8) rows.push_back({v[0], make_transform({v[1], v[2], v[3]}, Quaterniond(v[7], v[4], v[5], v[6]))});
  }
  return rows;
}

struct Distance {
  double position = 0.0;  // [m]
  double angle = 0.0;     // [rad]
};

class ReferenceTrajectory : public testing::TestWithParam<Case> {
 protected:
  void SetUp() override {
    folder_of_data_ = test_support::checkout("test/data/reference/");
    if (GetParam().motion.find("vicon") != std::string::npos || GetParam().motion == "motion_stylus") {
      folder_of_data_ = test_support::extra_data("reference/");
      if (folder_of_data_.empty()) GTEST_SKIP() << "SPRING_WORKBENCH_TEST_DATA is not given";
    }
    folder_.write("object.urdf", scene_of(GetParam().body));
    folder_.write("settings.yaml", GetParam().settings +
                                       "gravity: 9.81\ncontact: none\nintegrator: exponential\nrate: 50\n"
                                       "grasp.object: object\nstart.follow: true\n");
  }

  /// The motion up to half a second after `until`, or all of it.
  void write_motion(double until) const {
    std::ifstream file(folder_of_data_ + GetParam().motion + ".tum");
    std::string text;
    for (std::string line; std::getline(file, line);) {
      if (line[0] == '#' || std::stod(line) <= until + 0.5) text += line + "\n";
    }
    folder_.write("hand.tum", text);
  }

  /// The largest distance from the reference up to the time `until` [s].
  Distance run(const std::string& step, double until) const {
    write_motion(until);
    const std::string command = "cd '" + folder_.path(".") + "' && '" + test_support::program("replay") +
                                "' --scene object.urdf --motion hand.tum --settings settings.yaml --set step=" + step +
                                " --out run.csv >summary";
    const int status = std::system(command.c_str());
    EXPECT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) == 0);
    const std::vector<Row> rows = read_rows(folder_.path("run.csv"));
    Distance distance;
    std::size_t compared = 0;
    for (const Row& reference : read_rows(folder_of_data_ + GetParam().name + ".csv")) {
      if (reference.t > until || compared == rows.size()) break;
      const Row& row = rows[compared++];
      EXPECT_NEAR(row.t, reference.t, 1e-9);
      const Vector3d gap = row.X_WO.translation() - reference.X_WO.translation();
      distance.position = std::max(distance.position, gap.norm());
      const Eigen::AngleAxisd turn(Matrix3d(row.X_WO.linear().transpose() * reference.X_WO.linear()));
      distance.angle = std::max(distance.angle, std::abs(turn.angle()));
    }
    EXPECT_GE(static_cast<double>(compared), 50.0 * until * 0.99) << "not all times were compared";
    std::cout << GetParam().name << " step " << step << ": " << distance.position << " m, " << distance.angle
              << " rad\n";
    return distance;
  }

  std::string folder_of_data_;
  test_support::TemporaryFolder folder_;
};

TEST_P(ReferenceTrajectory, IsMetWithOneStepPerSample) {
  const Distance distance = run("0.02", GetParam().until);
  EXPECT_LT(distance.position, GetParam().one_step_per_sample);
  EXPECT_LT(distance.angle, 10.0 * GetParam().one_step_per_sample);
}

TEST_P(ReferenceTrajectory, IsMetAtAMillisecond) {
  const Distance distance = run("0.001", GetParam().until);
  EXPECT_LT(distance.position, GetParam().millisecond);
  EXPECT_LT(distance.angle, 10.0 * GetParam().millisecond);
}

TEST_P(ReferenceTrajectory, IsMetMoreCloselyWithASmallStep) {
  const Distance distance = run("0.00005", 1.0);
  EXPECT_LT(distance.position, GetParam().small_step);
  EXPECT_LT(distance.angle, 10.0 * GetParam().small_step);
}

INSTANTIATE_TEST_SUITE_P(ByFormula, ReferenceTrajectory, testing::ValuesIn(by_formula()),
                         [](const auto& one) { return one.param.name; });
INSTANTIATE_TEST_SUITE_P(Recorded, ReferenceTrajectory, testing::ValuesIn(recorded()),
                         [](const auto& one) { return one.param.name; });

}  // namespace
}  // namespace spring_workbench
