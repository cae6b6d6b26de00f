#include <gtest/gtest.h>

#include <string>
#include <utility>
#include <vector>

#include "spring_workbench/fastrak/fastrak_source.h"
#include "spring_workbench/validation/input_error.h"

namespace spring_workbench::fastrak::fastrak_settings_test {
namespace {

TEST(FastrakSettings, AreReadFromAMap) {
  const FastrakSettings settings = read_fastrak_settings(
      YAML::Load("{port: /dev/x, baud: 9600, format: ascii, stations: [3, 1], orientation: euler, redundant: false, "
                 "hemisphere: 0 0 -1, stylus: false, else: 1}"),
      "/tracker");
  EXPECT_EQ(settings.port, "/dev/x");
  EXPECT_EQ(settings.baud, 9600);
  EXPECT_EQ(settings.format, FastrakFormat::ascii);
  EXPECT_EQ(settings.stations, (std::vector<int>{3, 1}));
  EXPECT_TRUE(settings.euler);
  EXPECT_FALSE(settings.redundant);
  EXPECT_TRUE(settings.styluses.empty());
  EXPECT_EQ(settings.hemisphere, Vector3d(0, 0, -1));
  EXPECT_EQ(read_fastrak_settings(YAML::Load("{stations: 2}"), "x").stations, std::vector<int>{2});
  EXPECT_EQ(read_fastrak_settings(YAML::Load("{stylus: true}"), "x").styluses, std::vector<int>{1});
  EXPECT_EQ(read_fastrak_settings(YAML::Load("{stations: [1, 2, 3], stylus: [3, 1]}"), "x").styluses,
            (std::vector<int>{3, 1}));
}

TEST(FastrakSettings, RefuseWithTheKeyInTheMessage) {
  const std::vector<std::pair<std::string, std::string>> cases{{"{port: ''}", "port"},
                                                               {"{baud: 12345}", "baud"},
                                                               {"{format: hex}", "format"},
                                                               {"{stations: []}", "stations"},
                                                               {"{stations: [0]}", "stations"},
                                                               {"{stations: [1, 5]}", "stations"},
                                                               {"{stations: [2, 2]}", "stations"},
                                                               {"{orientation: up}", "orientation"},
                                                               {"{redundant: 7}", "redundant"},
                                                               {"{stylus: 7}", "stylus"},
                                                               {"{stylus: [2]}", "stylus"},
                                                               {"{stations: [1, 2], stylus: [2, 2]}", "stylus"},
                                                               {"{hemisphere: [1, 0]}", "hemisphere"},
                                                               {"{hemisphere: [.nan, 0, 0]}", "hemisphere"}};
  for (const auto& [yaml, key] : cases) {
    std::string message;
    try {
      read_fastrak_settings(YAML::Load(yaml), "/tracker");
    } catch (const validation::InputError& error) {
      message = error.what();
    }
    EXPECT_NE(message.find("/tracker"), std::string::npos) << yaml;
    EXPECT_NE(message.find(" " + key + ":"), std::string::npos) << yaml << ": " << message;
  }
}

/// Each chunk terminates a preceding incomplete command, none leaves one open, and the switch cannot stop the stream.
TEST(FastrakSettings, TheSetUpAsksForEverythingThatTheDriverReliesOn) {
  FastrakSettings settings;
  settings.stations = {1, 3};
  settings.hemisphere = Vector3d(0, 0, -1);
  std::string all;
  for (const std::string& portion : fastrak_set_up(settings)) {
    EXPECT_LT(portion.size(), 64u);
    all += portion;
  }
  for (const char* command : {"\rc", "u", "l1,1\r", "l2,0\r", "l3,1\r", "l4,0\r", "O1,2,0,11,16,52,61,66\r",
                              "O3,2,11,52,0,61\r", "H1,0,0,-1\r", "H3,0,0,-1\r", "I3,0\r", "e1,0\r", "f"}) {
    EXPECT_NE(all.find(command), std::string::npos) << command;
  }
  EXPECT_LT(all.find("l3,1"), all.find("l2,0"));  // the last active station cannot be switched off
}

}  // namespace
}  // namespace spring_workbench::fastrak::fastrak_settings_test
