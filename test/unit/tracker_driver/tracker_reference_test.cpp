#include <gtest/gtest.h>

#include <fstream>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "spring_workbench/hand_input/settings.h"
#include "spring_workbench/ros/tracker_driver/tracker_driver.h"
#include "spring_workbench/validation/input_error.h"

namespace spring_workbench::tracker_driver {
namespace {

/// The lines of doc/reference.md under a heading.
std::vector<std::string> section(const std::string& heading) {
  std::ifstream file(SPRING_WORKBENCH_SOURCE_DIR "/doc/reference.md");
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

/// Those that the driver knows, as its refusal of an unknown one lists them.
std::set<std::string> known_parameters(const std::string& source) {
  std::set<std::string> names;
  try {
    read_tracker_parameters(YAML::Load("{source: " + source + ", no_such_key: 1}"), "/tracker_driver");
  } catch (const validation::InputError& error) {
    const std::string text = error.what(), marker = "known are ";
    std::string list = text.substr(text.find(marker) + marker.size());
    for (char& c : list) c = c == ',' ? ' ' : c;
    std::istringstream words(list);
    for (std::string word; words >> word;) names.insert(word);
  }
  return names;
}

TEST(TrackerReference, ParametersAreThoseOfTheCode) {
  std::set<std::string> known{"grasp"};  // a service, in a table of its own
  for (const char* source : {"fastrak", "motion_file", "operator", "interactive_marker", "joy"}) {
    for (const std::string& name : known_parameters(source)) known.insert(name);
  }
  EXPECT_GT(known.size(), 20u);
  EXPECT_EQ(documented_parameters("`tracker_driver`"), known);
}

TEST(TrackerReference, TruthSettingsAreThoseOfTheCode) {
  std::string given;
  for (const std::string& line : section("Truth settings")) {
    if (line.rfind("| `truth.", 0) == 0) given += line + "\n";
  }
  std::string right;
  for (const hand_input::TruthDescription& d : hand_input::truth_descriptions()) {
    right += "| `truth." + d.key + "` | " + d.unit + " | " + d.allowed + " | " + d.default_value + " | " + d.meaning +
             " |\n";
  }
  EXPECT_TRUE(given == right) << "put these rows into doc/reference.md:\n" << right;
}

}  // namespace
}  // namespace spring_workbench::tracker_driver
