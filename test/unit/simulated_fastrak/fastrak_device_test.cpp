#include "spring_workbench/simulated_fastrak/fastrak_device.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "spring_workbench/fastrak/fastrak_decoder.h"
#include "spring_workbench/validation/input_error.h"
#include "support/played_motions.h"

namespace spring_workbench::simulated_fastrak::fastrak_device_test {
namespace {

using test_support::circling_hand;
using namespace fastrak;

FastrakDevice device_with(std::size_t stations) {
  return FastrakDevice(std::vector<PlayedMotion>(stations, circling_hand()));
}

std::size_t count_records(const std::string& bytes, const std::map<int, FastrakLayout>& layouts) {
  return FastrakDecoder(layouts).decode(bytes).size();
}

TEST(FastrakDevice, AtPowerOnItAnswersInInchesWithPositionAndAngles) {
  FastrakDevice device = device_with(2);
  EXPECT_EQ(device.measure(0.1), "");
  const std::string response = device.receive("P");
  EXPECT_EQ(response.size(), 2u * 47u);
  const FastrakLayout layout({2, 4, 1}, FastrakFormat::ascii, FastrakUnits::inches);
  const motion::StylusSample truth = circling_hand().at(0.1);
  for (const std::size_t station : {0u, 1u}) {
    const auto record = layout.decode(response.substr(47 * station, 47));
    ASSERT_TRUE(record);
    EXPECT_EQ(record->station, static_cast<int>(station) + 1);
    EXPECT_LT((record->p_TS - truth.X.translation()).cwiseAbs().maxCoeff(), 0.0051 * 0.0254);
    EXPECT_LT((record->q_TS.toRotationMatrix() - truth.X.linear()).norm(), 5e-4);
  }
  EXPECT_EQ(device.receive("S").substr(0, 6), "21S3F4");
}

TEST(FastrakDevice, StreamsItsStationsInTurn) {
  for (std::size_t stations = 1; stations <= 4; ++stations) {
    FastrakDevice device = device_with(stations);
    device.receive("fuC");
    for (std::size_t i = 0; i < 12; ++i) {
      const std::string record = device.measure(static_cast<double>(i) / 120.0);
      ASSERT_GT(record.size(), 2u);
      EXPECT_EQ(record[1], static_cast<char>('1' + i % stations));
    }
    EXPECT_EQ(device.receive("S").substr(3, 3), "3FF");
    device.receive("c");
    EXPECT_EQ(device.measure(1.0), "");
  }
}

/// The original device supports only the switch of station 1; emulations may support others.
TEST(FastrakDevice, TellsTheSwitchesThatItServes) {
  for (const std::vector<int>& switches : {std::vector<int>{1}, std::vector<int>{1, 2}}) {
    FastrakDevice device(std::vector<PlayedMotion>(2, circling_hand()), switches);
    const bool second = switches.size() > 1;
    EXPECT_EQ(device.receive("e2,0\r").empty(), second);
    device.receive("e1,0\rfuO1,2,11,16,0\rO2,2,11,16,0\rC");
    const std::vector<int> list{2, 11, 16, 0};
    const FastrakLayout layout(list, FastrakFormat::binary, FastrakUnits::centimetres);
    int pressed = 0;
    for (int i = 0; i < 1200; ++i) {
      const double t = i / 120.0;
      const auto record = layout.decode(device.measure(t));
      ASSERT_TRUE(record);
      const bool down = circling_hand().at(t).button;
      pressed += down ? 1 : 0;
      EXPECT_EQ(record->button, down && (record->station == 1 || second)) << t;
    }
    EXPECT_GT(pressed, 100);
  }
}

TEST(FastrakDevice, TakesListsAndStationsAndReadsThemBack) {
  FastrakDevice device = device_with(3);
  EXPECT_EQ(device.receive("O1\r"), "21O 2 4 1\r\n");
  EXPECT_EQ(device.receive("O1,2,11,16,0\r"), "");
  EXPECT_EQ(device.receive("O1\r"), "21O 21116 0\r\n");
  EXPECT_EQ(device.receive("l1\r"), "21l1110\r\n");
  EXPECT_EQ(device.receive("l1,0\rl3,0\rl2,0\r"), "");
  EXPECT_EQ(device.receive("l1\r"), "21l0100\r\n");        // the last one stays on
  EXPECT_EQ(device.receive("l4,1\rl1\r"), "21l0100\r\n");  // no receiver there
}

TEST(FastrakDevice, RefusesWithTheManualsCodes) {
  FastrakDevice device = device_with(1);
  const std::vector<std::pair<std::string, std::string>> cases{
      {"Z", "EC-99"}, {"O5,2,4,1\r", "EC-3"}, {"O1,2,4,77\r", "EC-3"}, {"Ox\r", "EC-2"}, {"l\r", "EC-1"}};
  for (const auto& [command, code] : cases) {
    const std::string response = device.receive(command);
    EXPECT_EQ(response.substr(0, 10), "2 E*ERROR*") << command;
    EXPECT_NE(response.find(code), std::string::npos) << response;
  }
  EXPECT_EQ(device.receive("O1\r"), "21O 2 4 1\r\n");
  EXPECT_EQ(device.receive("H1,0.,0.0E+00,3\rI1,0\rN1,1,2,3\r"), "");
}

/// Mode 1, the default: the switch stops and starts the stream, or asks for records. Mode 0: it only shows.
TEST(FastrakDevice, TheSwitchActsUnlessItIsDisabled) {
  const PlayedMotion pressing = test_support::pressing_hand();  // down in the second half of each second
  FastrakDevice device({pressing});
  EXPECT_EQ(device.measure(0.2), "");
  EXPECT_EQ(device.measure(0.6).size(), 47u);
  device.receive("C");
  EXPECT_NE(device.measure(1.2), "");
  EXPECT_EQ(device.measure(1.6), "");
  EXPECT_EQ(device.measure(2.2), "");
  EXPECT_NE(device.measure(2.6), "");
  device.receive("e1,0\r");
  for (int i = 0; i < 100; ++i) EXPECT_NE(device.measure(3.0 + 0.1 * i), "");
}

TEST(FastrakDevice, OutsideItsHemisphereItSeesTheMirrorOfAPoint) {
  std::vector<motion::StylusSample> there(1);
  there[0].X.translation() = Vector3d(-0.3, 0.2, 0.1);
  FastrakDevice device({PlayedMotion(there)});
  device.receive("uf");
  const FastrakLayout layout({2, 4, 1}, FastrakFormat::binary, FastrakUnits::centimetres);
  EXPECT_LT((layout.decode(device.receive("P"))->p_TS - Vector3d(0.3, -0.2, -0.1)).norm(), 1e-7);
  device.receive("H1,-1,0,0\r");
  EXPECT_LT((layout.decode(device.receive("P"))->p_TS - Vector3d(-0.3, 0.2, 0.1)).norm(), 1e-7);
  device.receive("H1,0,0,0\r");
  EXPECT_LT((layout.decode(device.receive("P"))->p_TS - Vector3d(-0.3, 0.2, 0.1)).norm(), 1e-7);
}

TEST(FastrakDevice, PausesAndForgetsNothing) {
  FastrakDevice device = device_with(1);
  device.receive("C\x13");
  EXPECT_EQ(device.measure(0.0), "");
  device.receive("\x11");
  EXPECT_EQ(
      count_records(device.measure(0.1), {{1, FastrakLayout({2, 4, 1}, FastrakFormat::ascii, FastrakUnits::inches)}}),
      1u);
  device.receive("\x19");
  EXPECT_EQ(device.measure(0.2), "");
}

TEST(PlayedMotion, GoesRoundAndThroughItsSamples) {
  const auto sample = [](double t, const Quaterniond& q, const Vector3d& p, bool button) {
    motion::StylusSample s;
    s.t = t;
    s.X = make_transform(p, q);
    s.button = button;
    return s;
  };
  const Quaterniond none = Quaterniond::Identity(), half(0, 0, 0, 1);
  const std::vector<motion::StylusSample> samples{
      sample(5.0, none, {0, 0, 0}, false), sample(6.0, half, {1, 0, 0}, true), sample(6.0, none, {7, 0, 0}, false),
      sample(8.0, half, {1, 2, 0}, false)};
  const PlayedMotion motion(samples);
  for (const double round : {0.0, 3.0, 300.0}) {
    EXPECT_LT((motion.at(round + 0.25).X.translation() - Vector3d(0.25, 0, 0)).norm(), 1e-12);
    EXPECT_NEAR(Eigen::AngleAxisd(motion.at(round + 0.25).X.linear()).angle(), M_PI / 4, 1e-12);
    EXPECT_LT((motion.at(round + 2.0).X.translation() - Vector3d(1, 1, 0)).norm(), 1e-12);
    EXPECT_FALSE(motion.at(round + 0.5).button);
    EXPECT_TRUE(motion.at(round + 1.5).button);
  }
  EXPECT_THROW(PlayedMotion(std::vector<motion::StylusSample>()), validation::InputError);
  EXPECT_THROW(PlayedMotion(std::vector<motion::StylusSample>{sample(0.0, none, {0, 10, 0}, false)}),
               validation::InputError);
  EXPECT_THROW(FastrakDevice(std::vector<PlayedMotion>()), validation::InputError);
}

}  // namespace
}  // namespace spring_workbench::simulated_fastrak::fastrak_device_test
