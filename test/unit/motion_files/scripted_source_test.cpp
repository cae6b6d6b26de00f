#include "spring_workbench/motion_files/scripted_source.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "spring_workbench/math/so3.h"
#include "spring_workbench/motion_files/open_motion.h"
#include "spring_workbench/validation/input_error.h"
#include "support/temporary_folder.h"

namespace spring_workbench::motion_files::scripted_source_test {
namespace {

std::vector<motion::StylusSample> all_samples(const std::string& yaml) {
  const test_support::TemporaryFolder folder;
  folder.write("script.yaml", yaml);
  const auto source = open_motion(folder.path("script.yaml"));
  std::vector<motion::StylusSample> samples;
  while (const auto sample = source->next()) samples.push_back(*sample);
  return samples;
}

const char* const kScript =
    "rate: 100\n"
    "waypoints:\n"
    "  - {t: 5.0, pose: [0, 0, 0.3, 1, 0, 0, 0]}\n"
    "  - {t: 6.0, pose: [0.1, -0.2, 0.2, 1, 0, 0, 0], button: true}\n"
    "  - {t: 6.5, pose: [0.1, -0.2, 0.2, 0.6, 0.8, 0, 0], button: true}\n"
    "  - {t: 7.255, pose: [0.4, 0, 0.3, 0, 0, 0.6, 0.8]}\n";

TEST(ScriptedSource, PassesItsWaypointsAtTheirTimes) {
  const auto samples = all_samples(kScript);
  ASSERT_EQ(samples.size(), 227u);  // 0, 0.01, … 2.25, and the last waypoint at 2.255
  for (std::size_t i = 0; i + 1 < samples.size(); ++i) EXPECT_EQ(samples[i].t, static_cast<double>(i) / 100.0);
  EXPECT_NEAR(samples.back().t, 2.255, 1e-12);
  EXPECT_LT((samples[0].X.translation() - Vector3d(0, 0, 0.3)).norm(), 1e-15);
  EXPECT_LT((samples[100].X.translation() - Vector3d(0.1, -0.2, 0.2)).norm(), 1e-15);
  EXPECT_LT((samples[150].X.linear() - Quaterniond(0, 0.6, 0.8, 0).toRotationMatrix()).norm(), 1e-15);
  EXPECT_LT((samples.back().X.linear() - Quaterniond(0.8, 0, 0, 0.6).toRotationMatrix()).norm(), 1e-15);
  for (const motion::StylusSample& sample : samples)
    EXPECT_EQ(sample.button, sample.t >= 1.0 && sample.t < 2.25501 - 1e-4);
}

/// Minimum jerk from rest to rest: peak speed 15/8 of the mean, peak acceleration 10/√3 d/T² (Flash and Hogan 1985).
TEST(ScriptedSource, MovesWithMinimumJerk) {
  const auto samples = all_samples(
      "rate: 10000\nwaypoints:\n  - {t: 0, pose: [0, 0, 0, 0, 0, 0, 1]}\n"
      "  - {t: 2, pose: [0, 3, 0, 1, 0, 0, 0]}\n");
  double fastest = 0.0, hardest = 0.0, fastest_turn = 0.0;
  for (std::size_t i = 1; i + 1 < samples.size(); ++i) {
    const double before = samples[i - 1].X.translation().y(), here = samples[i].X.translation().y(),
                 after = samples[i + 1].X.translation().y();
    fastest = std::max(fastest, (after - before) / 2e-4);
    hardest = std::max(hardest, (after - 2.0 * here + before) / 1e-8);
    const Matrix3d turn = samples[i - 1].X.linear().transpose() * samples[i + 1].X.linear();
    fastest_turn = std::max(fastest_turn, math::log_so3(turn).norm() / 2e-4);
  }
  EXPECT_NEAR(fastest, 15.0 / 8.0 * 3.0 / 2.0, 1e-6);
  EXPECT_NEAR(hardest, 10.0 / std::sqrt(3.0) * 3.0 / 4.0, 1e-4);
  EXPECT_NEAR(fastest_turn, 15.0 / 8.0 * M_PI / 2.0, 1e-6);
}

TEST(ScriptedSource, OneWaypointIsOneSample) {
  const auto samples = all_samples("rate: 50\nwaypoints: [{t: 3, pose: [1, 2, 3, 0, 0, 0, 1], button: true}]");
  ASSERT_EQ(samples.size(), 1u);
  EXPECT_EQ(samples[0].t, 0.0);
  EXPECT_TRUE(samples[0].button);
}

TEST(ScriptedSource, BadScriptsNameFileLineFieldAndRule) {
  struct Bad {
    const char* yaml;
    const char* expected;
  };
  const Bad table[] = {
      {"rate: 0\nwaypoints: [{t: 0, pose: [0, 0, 0, 0, 0, 0, 1]}]",
       ":1: rate: invalid value '0': expected a number between"},
      {"rate: 50\nwaypoint: []", ":2: waypoint: unknown key; known keys are rate, waypoints"},
      {"rate: 50", ":1: missing required key waypoints: a list"},
      {"rate: 50\nwaypoints: []", ":2: waypoints: expected a list"},
      {"rate: 50\nwaypoints: 3", ":2: waypoints: expected a list"},
      {"rate: 50\nwaypoints: [3]", ":2: waypoints[0]"},
      {"waypoints: [{t: 0, pose: [0, 0, 0, 0, 0, 0, 1]}]", ":1: missing required key rate: a number"},
      {"rate: 50\nwaypoints:\n - {t: .nan, pose: [0, 0, 0, 0, 0, 0, 1]}",
       ":3: waypoints[0].t: invalid value '.nan': expected"},
      {"rate: 50\nwaypoints:\n - {t: 0, pose: [0, 0, 0, 0, 0, 0, 0]}", ":3: waypoints[0].pose: "},
      {"rate: 50\nwaypoints:\n - {t: 0}", ":3: missing required key waypoints[0].pose: x y z qx qy qz qw (7 finite"},
      {"rate: 50\nwaypoints:\n - {t: 0, pose: [0, 0, 0, 0, 0, 0, 1], button: 3}",
       ":3: waypoints[0].button: invalid value '3': expected true or false"},
      {"rate: 50\nwaypoints:\n - {t: 0, pose: [0, 0, 0, 0, 0, 0, 1]}\n - {t: 0, pose: [0, 0, 0, 0, 0, 0, 1]}",
       ":4: waypoints[1].t: invalid value '0': expected a time later than"},
      {"rate: 10000\nwaypoints:\n - {t: 5, pose: [0, 0, 0, 0, 0, 0, 1]}\n - {t: 1e6, pose: [0, 0, 0, 0, 0, 0, 1]}",
       ":4: waypoints[1].t: invalid value '1e6': expected at most 1000 s after the first (1e7 samples at rate = "
       "10000 Hz)"},
      {"rate: [", ":1: not YAML"},
  };
  const test_support::TemporaryFolder folder;
  const std::string path = folder.path("script.yaml");
  for (const Bad& bad : table) {
    folder.write("script.yaml", bad.yaml);
    std::string message;
    try {
      ScriptedSource source(path);
    } catch (const validation::InputError& e) {
      message = e.what();
    }
    const std::string start = path + bad.expected;
    EXPECT_EQ(message.substr(0, start.size()), start) << bad.yaml;
    EXPECT_EQ(message.find('\n'), std::string::npos) << message;
  }
}

}  // namespace
}  // namespace spring_workbench::motion_files::scripted_source_test
