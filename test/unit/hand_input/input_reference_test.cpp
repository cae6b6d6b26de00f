#include <gtest/gtest.h>

#include <fstream>
#include <string>

#include "spring_workbench/hand_input/settings.h"
#include "support/paths.h"

namespace spring_workbench::hand_input::input_reference_test {
namespace {

TEST(InputReference, SettingsAreThoseOfTheCode) {
  std::ifstream file(test_support::checkout("doc/reference.md"));
  std::string given, right;
  for (std::string line; std::getline(file, line);) {
    if (line.rfind("| `input.", 0) == 0) given += line + "\n";
  }
  for (const InputSettingDescription& d : input_descriptions()) {
    right += "| `input." + d.key + "` | " + d.unit + " | " + d.allowed + " | " + d.default_value + " | " + d.meaning +
             " |\n";
  }
  EXPECT_TRUE(given == right) << "put these rows into doc/reference.md:\n" << right;
}

}  // namespace
}  // namespace spring_workbench::hand_input::input_reference_test
