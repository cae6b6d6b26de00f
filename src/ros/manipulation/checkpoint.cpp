#include "spring_workbench/ros/manipulation/checkpoint.h"

#include <map>

#include "spring_workbench/config/yaml_fields.h"
#include "spring_workbench/ros/common/parameters.h"

namespace spring_workbench::manipulation {
namespace {

const std::string kKey = "resume";
constexpr double kPeriod = 0.5;  // s

XmlRpc::XmlRpcValue list(std::initializer_list<double> numbers) {
  XmlRpc::XmlRpcValue value;
  int i = 0;
  for (const double number : numbers) value[i++] = number;
  return value;
}

XmlRpc::XmlRpcValue list(const rod::PerDof& f) { return list({f.stretch, f.bend, f.torsion}); }

XmlRpc::XmlRpcValue state_of(const simulation::Simulation& simulation) {
  const dynamics::DynamicsSettings& dynamics = simulation.settings().dynamics;
  XmlRpc::XmlRpcValue state;
  state["scene"] = simulation.scene().path;
  for (std::size_t hand = 0; hand < simulation::Simulation::most_hands; ++hand) {
    const rod::ForkSettings& fork = simulation.fork_settings(hand);
    XmlRpc::XmlRpcValue of_hand;
    of_hand["tool"] = validation::name_of(simulation.fork(hand).tool);
    of_hand["dofs"] = list({fork.dofs.stretch ? 1.0 : 0.0, fork.dofs.bend ? 1.0 : 0.0, fork.dofs.torsion ? 1.0 : 0.0});
    of_hand["stiffness"] = list(fork.stiffness);
    of_hand["damping"] = list(fork.damping_ratio);
    of_hand["damping_coefficient"] = list(fork.damping_coefficient);
    of_hand["damping_law"] = validation::name_of(fork.damping_law);
    state["hands"][static_cast<int>(hand)] = of_hand;
  }
  state["integrator"] = validation::name_of(dynamics.integrator);
  state["step"] = dynamics.step;
  state["tolerance"] = dynamics.tolerance;
  XmlRpc::XmlRpcValue objects;
  objects.setSize(0);
  for (const bodies::BodyState& object : simulation.objects()) {
    const Vector3d& p = object.X_WO.translation();
    const Quaterniond q(object.X_WO.linear());
    XmlRpc::XmlRpcValue entry;
    entry["name"] = object.name;
    entry["pose"] = list({p.x(), p.y(), p.z(), q.x(), q.y(), q.z(), q.w()});
    objects[objects.size()] = entry;
  }
  state["objects"] = objects;
  return state;
}

rod::PerDof read_per_dof(const YAML::Node& state, const std::string& key) {
  const std::vector<double> numbers = config::read_numbers(state[key], kKey, key, 3);
  return {numbers[0], numbers[1], numbers[2]};
}

void set(simulation::Simulation& simulation, const YAML::Node& state) {
  for (std::size_t hand = 0; hand < simulation::Simulation::most_hands; ++hand) {
    const YAML::Node of_hand = state["hands"][hand];
    const rod::PerDof dofs = read_per_dof(of_hand, "dofs");
    rod::ForkSettings fork;
    fork.dofs = {dofs.stretch != 0.0, dofs.bend != 0.0, dofs.torsion != 0.0};
    fork.stiffness = read_per_dof(of_hand, "stiffness");
    fork.damping_ratio = read_per_dof(of_hand, "damping");
    fork.damping_coefficient = read_per_dof(of_hand, "damping_coefficient");
    fork.damping_law = config::read_named<rod::DampingLaw>(of_hand["damping_law"], kKey, "damping_law");
    simulation.change(simulation::change_to(fork), hand);
    simulation.select_tool(config::read_named<tools::Tool>(of_hand["tool"], kKey, "tool"), hand);
  }
  simulation::DynamicsChange change;
  change.integrator = config::read_named<dynamics::IntegratorKind>(state["integrator"], kKey, "integrator");
  change.step = config::read_number(state["step"], kKey, "step", validation::positive());
  change.tolerance = config::read_number(state["tolerance"], kKey, "tolerance", validation::not_negative());
  simulation.change(change);
}

}  // namespace

Checkpoint::Checkpoint(const ros::NodeHandle& private_node, SimulationRunner& runner,
                       const std::vector<std::string>& scene_roots)
    : private_node_(private_node), runner_(runner) {
  resume(scene_roots);
  private_node_.getParam(private_node_.getNamespace(), parameters_);
  timer_ = private_node_.createWallTimer(ros::WallDuration(kPeriod), [this](const ros::WallTimerEvent&) { keep(); });
}

Checkpoint::~Checkpoint() {
  timer_.stop();
  if (!handed_over_) private_node_.deleteParam(kKey);
}

void Checkpoint::keep() {
  XmlRpc::XmlRpcValue now =
      runner_.locked([](const simulation::Simulation& simulation) { return state_of(simulation); });
  now["given_scene"] = parameters_["scene"];
  if (now == kept_) return;
  kept_ = now;
  private_node_.setParam(kKey, kept_);
}

void Checkpoint::hand_over() {
  handed_over_ = true;
  timer_.stop();
  private_node_.setParam(private_node_.getNamespace(), parameters_);
  kept_ = XmlRpc::XmlRpcValue();
  keep();
}

void Checkpoint::resume(const std::vector<std::string>& scene_roots) {
  const YAML::Node parameters = ros_common::private_parameters(private_node_);
  const YAML::Node state = parameters[kKey];
  if (!state) return;
  try {
    if (!state.IsMap() || !state["objects"].IsSequence() || !state["hands"].IsSequence()) {
      validation::refuse("parameter", kKey, "what is given", "as this node left it");
    }
    if (config::read_string(state["given_scene"], kKey, "given_scene") != parameters["scene"].as<std::string>()) return;
    const std::string scene = config::read_string(state["scene"], kKey, "scene");
    std::map<std::string, RigidTransform> places;
    for (const YAML::Node& object : state["objects"]) {
      places[config::read_string(object["name"], kKey, "name")] = config::read_pose(object["pose"], kKey, "pose");
    }
    const scene::Scene present =
        runner_.locked([](const simulation::Simulation& simulation) { return simulation.scene(); });
    runner_.resume(
        present.path == scene ? present : scene::load_scene(scene, scene_roots),
        [&](simulation::Simulation& simulation) { set(simulation, state); }, places);
    ROS_WARN("going on where the node of this name was when it ended without warning; nothing is held");
  } catch (const std::exception& error) {  // a broken one must not keep the node from starting
    ROS_WARN_STREAM("starting anew: " << error.what());
  }
}

}  // namespace spring_workbench::manipulation
