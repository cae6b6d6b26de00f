#include "spring_workbench/ros/common/parameters.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "spring_workbench/ros/manipulation/manipulation_parameters.h"
#include "spring_workbench/validation/input_error.h"

namespace spring_workbench::manipulation::parameters_test {
namespace {

using XmlRpc::XmlRpcValue;

template <typename Read>
std::string refusal(Read&& read) {
  try {
    read();
  } catch (const validation::InputError& error) {
    EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos) << error.what();
    return error.what();
  }
  return "";
}

std::string refusal_of(const std::string& yaml) {
  return refusal([&] { read_manipulation_parameters(YAML::Load(yaml), "/manipulation"); });
}

TEST(ToYaml, KeepsEveryDoubleToTheLastBit) {
  for (const double value : {0.1, -1.0 / 3.0, 6.02214076e23, 5e-324, std::numeric_limits<double>::max()}) {
    EXPECT_EQ(ros_common::to_yaml(XmlRpcValue(value), "x").as<double>(), value);
  }
  EXPECT_TRUE(std::isnan(ros_common::to_yaml(XmlRpcValue(std::numeric_limits<double>::quiet_NaN()), "x").as<double>()));
  EXPECT_EQ(ros_common::to_yaml(XmlRpcValue(std::numeric_limits<double>::infinity()), "x").as<double>(),
            std::numeric_limits<double>::infinity());
}

TEST(ToYaml, KeepsStructure) {
  XmlRpcValue list;
  list[0] = 1;
  list[1] = 2.5;
  XmlRpcValue value;
  value["flag"] = true;
  value["inner"]["text"] = "a b";
  value["list"] = list;
  const YAML::Node node = ros_common::to_yaml(value, "top");
  EXPECT_EQ(node["flag"].as<bool>(), true);
  EXPECT_EQ(node["inner"]["text"].as<std::string>(), "a b");
  EXPECT_EQ(node["list"].as<std::vector<double>>(), (std::vector<double>{1.0, 2.5}));
}

TEST(ToYaml, RefusesWhatYamlHasNoWordFor) {
  EXPECT_NE(refusal([] {
              char bytes[] = {1, 2};
              ros_common::to_yaml(XmlRpcValue(bytes, 2), "blob");
            }).find("blob"),
            std::string::npos);
}

TEST(ManipulationParameters, NodeAndSimulationAreReadFromOneMap) {
  const auto parameters =
      read_manipulation_parameters(YAML::Load("{scene: a.urdf, rate: 250, stylus_frame: pen, frame_prefix: left_, "
                                              "fork: {stiffness: {bend: 77}}, integrator: rk4}"),
                                   "/m");
  EXPECT_EQ(parameters.scene, "a.urdf");
  EXPECT_EQ(parameters.rate, 250.0);
  EXPECT_EQ(parameters.stylus_frame, "pen");
  EXPECT_EQ(parameters.frame_prefix, "left_");
  EXPECT_EQ(parameters.simulation.fork.stiffness.bend, 77.0);
  EXPECT_EQ(parameters.simulation.dynamics.integrator, dynamics::IntegratorKind::rk4);
  EXPECT_EQ(parameters.world_frame, ManipulationParameters().world_frame);
}

TEST(ManipulationParameters, RefusesWithTheKeyInTheMessage) {
  const std::vector<std::pair<std::string, std::string>> cases{
      {"{}", "scene"},
      {"{scene: a.urdf, scen: 1}", "scen"},
      {"{scene: a.urdf, rate: 0}", "rate"},
      {"{scene: a.urdf, rate: fast}", "rate"},
      {"{scene: a.urdf, max_age: .nan}", "max_age"},
      {"{scene: a.urdf, world_frame: /world}", "world_frame"},
      {"{scene: a.urdf, frame_prefix: /left_}", "frame_prefix"},
      {"{scene: a.urdf, fork: {stiffness: {bend: .nan}}}", "fork.stiffness.bend"},
      {"{scene: a.urdf, fork: {stiffness: {stretch: -1}}}", "fork.stiffness.stretch"},
      {"{scene: a.urdf, fork: {colour: red}}", "fork.colour"},
      {"{scene: [1, 2]}", "scene"}};
  for (const auto& [yaml, key] : cases) {
    const std::string message = refusal_of(yaml);
    EXPECT_NE(message.find("/manipulation"), std::string::npos) << yaml << ": " << message;
    EXPECT_NE(message.find(" " + key + ":"), std::string::npos) << yaml << ": " << message;
  }
}

}  // namespace
}  // namespace spring_workbench::manipulation::parameters_test
