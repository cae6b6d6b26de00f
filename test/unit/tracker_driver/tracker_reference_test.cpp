#include <gtest/gtest.h>
#include <yaml-cpp/yaml.h>

#include <cmath>
#include <fstream>
#include <limits>
#include <set>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "spring_workbench/ros/tracker_driver/tracker_driver.h"
#include "spring_workbench/ros/tracker_driver/tracker_parameters.h"
#include "spring_workbench/validation/input_error.h"
#include "support/paths.h"

namespace spring_workbench::tracker_driver::tracker_reference_test {
namespace {

/// The lines of doc/reference.md under a heading.
std::vector<std::string> section(const std::string& heading) {
  std::ifstream file(test_support::checkout("doc/reference.md"));
  std::vector<std::string> lines;
  bool inside = false;
  for (std::string line; std::getline(file, line);) {
    if (line.rfind("## ", 0) == 0) inside = line == "## " + heading;
    if (inside) lines.push_back(line);
  }
  return lines;
}

/// The first cells "`~name`" of the section's tables.
std::set<std::string> documented_parameters(const std::string& heading) {
  std::set<std::string> names;
  for (const std::string& line : section(heading)) {
    const std::string begin = "| `~";
    if (line.rfind(begin, 0) == 0) names.insert(line.substr(begin.size(), line.find('`', begin.size()) - begin.size()));
  }
  return names;
}

/// The line that refuses these parameters; empty where they are taken.
std::string refusal_of(const std::string& yaml) {
  try {
    read_tracker_parameters(YAML::Load(yaml), "/tracker_driver");
  } catch (const validation::InputError& error) {
    EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos) << error.what();
    return error.what();
  }
  return "";
}

/// Those that the driver knows, as its refusal of an unknown one lists them.
std::set<std::string> known_parameters(const std::string& source) {
  const std::string text = refusal_of("{source: " + source + ", no_such_key: 1}"), marker = "known keys are ";
  std::string list = text.substr(text.find(marker) + marker.size());
  for (char& c : list) c = c == ',' ? ' ' : c;
  std::set<std::string> names;
  std::istringstream words(list);
  for (std::string word; words >> word;) names.insert(word);
  return names;
}

TEST(TrackerReference, ParametersAreThoseOfTheCode) {
  std::set<std::string> known{"grasp"};  // a service, in a table of its own
  for (const char* source : {"fastrak", "motion_file", "operator", "mouse", "joy"}) {
    for (const std::string& name : known_parameters(source)) known.insert(name);
  }
  EXPECT_GT(known.size(), 20u);
  EXPECT_EQ(documented_parameters("`tracker_driver`"), known);
}

TEST(WhyNotSent, AnyPoseIsSentAndNothingElse) {
  const auto reason = [](const Vector3d& p, const Quaterniond& q, const std::string& source = "fastrak") {
    return why_not_sent({1, 0.0, p, q, false, ' '}, source);
  };
  const Quaterniond unit(0.6, 0.0, 0.8, 0.0), identity = Quaterniond::Identity();
  const double inf = std::numeric_limits<double>::infinity();
  EXPECT_EQ(reason({1e6, 0.0, -3.0}, unit), "");
  EXPECT_EQ(reason(Vector3d::Zero(), unit), "");
  EXPECT_EQ(reason({1e-9, 0.0, 0.0}, identity), "");
  for (const double bad : {inf, -inf, std::nan("")}) {
    for (int i = 0; i < 4; ++i) {
      Quaterniond q = unit;
      q.coeffs()[i] = bad;
      EXPECT_EQ(reason(Vector3d::Zero(), q), "not finite");
    }
    for (int i = 0; i < 3; ++i) EXPECT_EQ(reason(bad * Vector3d::Unit(i), unit), "not finite");
  }
  EXPECT_EQ(reason(Vector3d::Zero(), Quaterniond(0.0, 0.0, 0.0, 0.0)), "not a unit quaternion");
  EXPECT_EQ(reason(Vector3d::Zero(), Quaterniond(1.2, 0.0, 0.0, 0.0)), "not a unit quaternion");
  EXPECT_EQ(reason(Vector3d::Zero(), identity), "out of view");
  EXPECT_EQ(reason(Vector3d::Zero(), identity, "joy"), "");
}

TEST(TrackerParameters, InputSettingsAreReportedAsThoseOfManipulation) {
  for (const std::string key : {"input", "truth"}) {
    EXPECT_EQ(refusal_of("{file: a.tum, " + key + ": {max_speed: 5}}"),
              "/tracker_driver: " + key + ": unknown key; it is now the parameter ~input of manipulation");
  }
}

TEST(TrackerParameters, SourcesAreCalledAsTheLaunchFilesCallThem) {
  EXPECT_EQ(refusal_of("{source: rat}"),
            "/tracker_driver:1: source: invalid value 'rat': expected one of mouse, joy, fastrak, operator, scripted, "
            "motion_file");
  for (const char* source : {"mouse", "interactive_marker"})
    EXPECT_EQ(read_tracker_parameters(YAML::Load("{source: " + std::string(source) + "}"), "").source, "mouse");
}

TEST(TrackerParameters, RefusesWithTheKeyInTheMessage) {
  const std::vector<std::pair<std::string, std::string>> cases{
      {"{}", "file"},
      {"{file: a, source: mice}", "source"},
      {"{file: a, speed: 0}", "speed"},
      {"{file: a, offset: [0, 0, 0, 0, 0, 0, 0]}", "offset"},
      {"{file: a, offset: [0, 0, 0, 0, 0, 0, 1], start: [0, 0, 0, 0, 0, 0, 1]}", "start"},
      {"{file: a, grasp_from: 2, grasp_until: 1}", "grasp_until"},
      {"{file: a, looop: true}", "looop"},
      {"{file: a, port: /dev/x}", "port"},
      {"{source: fastrak, file: a}", "file"},
      {"{source: fastrak, baud: 1}", "baud"},
      {"{source: fastrak, head_stations: [1]}", "head_stations"},
      {"{source: fastrak, stations: [1, 2], head_stations: 2}", "head_stations"},
      {"{source: fastrak, stations: [1, 2], head_stations: [2, 2]}", "head_stations"},
      {"{source: fastrak, stations: [1, 2], head_stations: [3]}", "head_stations"},
      {"{source: joy, head_stations: [2]}", "head_stations"}};
  for (const auto& [yaml, key] : cases) {
    const std::string message = refusal_of(yaml);
    EXPECT_NE(message.find(" " + key + ":"), std::string::npos) << yaml << ": " << message;
  }
}

TEST(EyeFrame, IsNamedAfterTheHead) {
  for (const auto& [head, eye] :
       {std::pair("head", "eye_left"), std::pair("head_2", "eye_left_2"), std::pair("left_head", "left_eye_left"),
        std::pair("a/head_3", "a/eye_left_3"), std::pair("visitor", "visitor_eye_left")})
    EXPECT_EQ(eye_frame(head, "eye_left"), eye);
}

}  // namespace
}  // namespace spring_workbench::tracker_driver::tracker_reference_test
