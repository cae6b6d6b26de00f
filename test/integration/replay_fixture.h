#pragma once

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <sstream>
#include <string>
#include <vector>

#include "support/paths.h"
#include "support/temporary_folder.h"

namespace spring_workbench {

inline const char* const kScene = R"(<robot name="one_box">
  <link name="workbench"/>
  <link name="box">
    <inertial><mass value="0.5"/><inertia ixx="4e-4" ixy="0" ixz="0" iyy="4e-4" iyz="0" izz="4e-4"/></inertial>
    <collision><geometry><box size="0.06 0.06 0.06"/></geometry></collision>
  </link>
  <joint name="box_joint" type="floating">
    <parent link="workbench"/><child link="box"/><origin xyz="0 0 0.03"/>
  </joint>
</robot>
)";

struct Sample {
  long milliseconds;
  double x, y, z, qx, qy, qz, qw;
  bool button;
};

/// A hand above the box, fork down, that grasps it, lifts it, puts it down beside its start, and releases it.
inline std::vector<Sample> lifting_hand() {
  std::vector<Sample> samples;
  for (long i = 0; i <= 100; ++i) {
    const double u = static_cast<double>(i) / 100.0;
    const double z = 0.24 + 0.1 * std::pow(std::sin(M_PI * u), 2);
    const double turn = 0.2 * u;
    samples.push_back({20 * i, 0.1 * u * u, 0.0, z, std::cos(turn), std::sin(turn), 0.0, 0.0, i > 10 && i < 90});
  }
  return samples;
}

inline std::string motion_text(const std::vector<Sample>& samples, double t_first = 0.0) {
  std::string text = "# t x y z qx qy qz qw button\n";
  for (const Sample& s : samples) {
    char line[300];
    std::snprintf(line, sizeof line, "%.3f %.17g %.17g %.17g %.17g %.17g %.17g %.17g %d\n",
                  t_first + 1e-3 * static_cast<double>(s.milliseconds), s.x, s.y, s.z, s.qx, s.qy, s.qz, s.qw,
                  s.button);
    text += line;
  }
  return text;
}

inline std::string content(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

struct Outcome {
  int status;
  std::string out, err;
};

class Replay : public testing::Test {
 protected:
  void SetUp() override {
    folder_.write("box.urdf", kScene);
    folder_.write("hand.tum", motion_text(lifting_hand()));
  }

  std::string path(const std::string& name) const { return folder_.path(name); }

  /// Runs `replay` in the test's folder; `arguments` as typed into a shell.
  Outcome run(const std::string& arguments) const {
    const std::string command =
        "cd '" + path(".") + "' && '" + test_support::program("replay") + "' " + arguments + " >stdout 2>stderr";
    const int status = std::system(command.c_str());
    return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, content(path("stdout")), content(path("stderr"))};
  }

  YAML::Node summary_of(const Outcome& outcome) const {  // JSON is YAML
    std::istringstream lines(outcome.out);
    std::string last;
    for (std::string line; std::getline(lines, line);) last = line;
    return YAML::Load(last);
  }

  std::vector<std::vector<std::string>> table(const std::string& name) const {
    std::vector<std::vector<std::string>> rows;
    std::istringstream lines(content(path(name)));
    for (std::string line; std::getline(lines, line);) {
      rows.emplace_back();
      std::istringstream cells(line);
      for (std::string cell; std::getline(cells, cell, ',');) rows.back().push_back(cell);
    }
    return rows;
  }

  void expect_same_bytes(const std::string& a, const std::string& b) const {
    EXPECT_GT(content(path(a)).size(), 1000u);
    EXPECT_TRUE(content(path(a)) == content(path(b))) << a << " and " << b << " differ";
  }

  void expect_refused(const std::string& arguments, const std::vector<std::string>& words) const {
    const Outcome outcome = run(arguments);
    EXPECT_EQ(outcome.status, 2) << arguments;
    EXPECT_EQ(outcome.out, "") << arguments;
    EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
    EXPECT_EQ(outcome.err.rfind("replay: ", 0), 0u) << outcome.err;
    for (const std::string& word : words) {
      EXPECT_NE(outcome.err.find(word), std::string::npos) << "no '" << word << "' in: " << outcome.err;
    }
    for (const auto& entry : std::filesystem::directory_iterator(path("."))) {
      EXPECT_EQ(entry.path().filename().string().rfind("run.", 0), std::string::npos)
          << entry.path() << " left by " << arguments;
    }
  }

  test_support::TemporaryFolder folder_;
};

}  // namespace spring_workbench
