// `replay` against the trajectories of an independent solver: long double, rod integrated over 24 sections, adaptive
// Runge-Kutta-Fehlberg 7(8).
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

struct Case {
  std::string name;
  std::string motion;
  Body body;
  std::string settings;
};

std::ostream& operator<<(std::ostream& out, const Case& one) { return out << one.name; }

std::string fork(const std::string& length, const std::string& stretch, const std::string& bend,
                 const std::string& torsion, const std::string& tip) {
  return "fork: {length: " + length + ", stiffness: {stretch: " + stretch + ", bend: " + bend +
         ", torsion: " + torsion + "}}\ngrasp.tip_in_object: " + tip + " 0 0 0 1\n";
}

std::vector<Case> cases() {
  const std::string soft = fork("0.2", "2000", "500", "5", "0.03 0.02 -0.05");
  return {
      {"soft_6dof", "motion_vicon", kSoft, soft},
      {"soft_constant_shape", "motion_vicon", kSoft, soft + "shape: constant\n"},
      {"torsion_only", "motion_vicon", kSoft, soft + "fork.dofs: {stretch: false, bend: false}\n"},
      {"bend_only", "motion_vicon", kSoft, soft + "fork.dofs: {stretch: false, torsion: false}\n"},
      {"stretch_only", "motion_vicon", kSoft, soft + "fork.dofs: {bend: false, torsion: false}\n"},
      {"underdamped", "motion_vicon", kSoft, soft + "fork.damping: {stretch: 0.1, bend: 0.1, torsion: 0.1}\n"},
      {"heavy_large_bend", "motion_vicon", kHeavy, fork("0.2", "1500", "150", "3", "0.02 0 -0.06")},
      {"stylus", "motion_stylus", kSoft, soft},
      {"stiff_6dof", "motion_vicon_1s", kLight, fork("0.15", "2e5", "5e4", "200", "0.01 0.01 -0.03")},
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
    if (v.size() == 8) rows.push_back({v[0], make_transform(Quaterniond(v[7], v[4], v[5], v[6]), {v[1], v[2], v[3]})});
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
    if (!std::ifstream(shared(GetParam().name + ".csv"))) {
      GTEST_SKIP() << "no reference trajectories in " << shared("");
    }
    folder_.write("object.urdf", scene_of(GetParam().body));
    folder_.write("settings.yaml", GetParam().settings +
                                       "gravity: 9.81\ncontact: none\nintegrator: exponential\nrate: 50\n"
                                       "grasp.object: object\nstart.follow: true\n");
  }

  static std::string shared(const std::string& name) {
    return std::string(SPRING_WORKBENCH_SHARED_DIR) + "/reference/" + name;
  }

  /// The motion up to half a second after `until`, or all of it.
  void write_motion(double until) const {
    std::ifstream file(shared(GetParam().motion + ".tum"));
    std::string text;
    for (std::string line; std::getline(file, line);) {
      if (line[0] == '#' || std::stod(line) <= until + 0.5) text += line + "\n";
    }
    folder_.write("hand.tum", text);
  }

  /// The largest distance from the reference up to the time `until` [s].
  Distance run(const std::string& step, double until) const {
    write_motion(until);
    const std::string command = "cd '" + folder_.path(".") +
                                "' && '" REPLAY_EXECUTABLE
                                "' --scene object.urdf --motion hand.tum --settings settings.yaml --set step=" +
                                step + " --out run.csv >summary";
    const int status = std::system(command.c_str());
    EXPECT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) == 0);
    const std::vector<Row> rows = read_rows(folder_.path("run.csv"));
    Distance distance;
    std::size_t compared = 0;
    for (const Row& reference : read_rows(shared(GetParam().name + ".csv"))) {
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

  test_support::TemporaryFolder folder_;
};

TEST_P(ReferenceTrajectory, IsMetWithOneStepPerSample) {
  const Distance distance = run("0.02", GetParam().motion == "motion_vicon_1s" ? 1.0 : 8.0);
  EXPECT_LT(distance.position, 1e-5);
  EXPECT_LT(distance.angle, 1e-4);
}

TEST_P(ReferenceTrajectory, IsMetAtAMillisecond) {
  const Distance distance = run("0.001", GetParam().motion == "motion_vicon_1s" ? 1.0 : 8.0);
  EXPECT_LT(distance.position, 1e-5);
  EXPECT_LT(distance.angle, 1e-4);
}

TEST_P(ReferenceTrajectory, IsMetMoreCloselyWithASmallStep) {
  const Distance distance = run("0.00005", 1.0);
  EXPECT_LT(distance.position, 1e-7);
  EXPECT_LT(distance.angle, 1e-6);
}

INSTANTIATE_TEST_SUITE_P(All, ReferenceTrajectory, testing::ValuesIn(cases()),
                         [](const auto& one) { return one.param.name; });

}  // namespace
}  // namespace spring_workbench
