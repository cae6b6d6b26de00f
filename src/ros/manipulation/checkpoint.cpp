#include "spring_workbench/ros/manipulation/checkpoint.h"

#include <utility>

#include "constants.h"
#include "spring_workbench/config/yaml_fields.h"
#include "spring_workbench/ros/common/parameters.h"

namespace spring_workbench::manipulation {
namespace {

const std::string kKey = "resume";

}  // namespace

Checkpoint::Checkpoint(const ros::NodeHandle& private_node, live::SimulationRunner& runner,
                       const std::vector<std::string>& scene_roots)
    : private_node_(private_node), runner_(runner) {
  resume(scene_roots);
  private_node_.getParam(private_node_.getNamespace(), parameters_);
  timer_ = private_node_.createSteadyTimer(ros::WallDuration(checkpoint_period),
                                           [this](const ros::SteadyTimerEvent&) { keep(); });
}

Checkpoint::~Checkpoint() {
  timer_.stop();
  if (!handed_over_) private_node_.deleteParam(kKey);
}

void Checkpoint::keep() {
  auto [scene, state] = runner_.locked([](const simulation::Simulation& simulation) {
    return std::make_pair(simulation.scene().path, simulation.save());
  });
  if (scene == kept_scene_ && state == kept_state_) return;
  XmlRpc::XmlRpcValue now;
  now["given_scene"] = parameters_["scene"];
  now["scene"] = scene;
  now["state"] = serialise(state);
  private_node_.setParam(kKey, now);
  kept_scene_ = std::move(scene);
  kept_state_ = std::move(state);
}

void Checkpoint::hand_over() {
  handed_over_ = true;
  timer_.stop();
  private_node_.setParam(private_node_.getNamespace(), parameters_);
  kept_scene_.clear();  // the new master knows nothing of it
  keep();
}

void Checkpoint::resume(const std::vector<std::string>& scene_roots) {
  const YAML::Node parameters = ros_common::private_parameters(private_node_);
  const YAML::Node kept = parameters[kKey];
  if (!kept) return;
  try {
    if (!kept.IsMap()) throw validation::InputError("parameter resume: must be the map that this node wrote");
    if (config::read_string(kept["given_scene"], kKey, "given_scene") != parameters["scene"].as<std::string>()) return;
    const std::string scene = config::read_string(kept["scene"], kKey, "scene");
    const auto state = simulation::parse_state(config::read_string(kept["state"], kKey, "state"));
    const scene::Scene present =
        runner_.locked([](const simulation::Simulation& simulation) { return simulation.scene(); });
    runner_.resume(present.path == scene ? present : scene::load_scene(scene, scene_roots), state);
    ROS_WARN("resuming from the state of the node that was killed; nothing is held");
  } catch (const std::exception& error) {  // a broken one must not keep the node from starting
    ROS_WARN_STREAM("the checkpoint is ignored: " << error.what());
  }
}

}  // namespace spring_workbench::manipulation
