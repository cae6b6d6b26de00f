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
  const simulation::SimulationSettings& settings = simulation.settings();
  XmlRpc::XmlRpcValue state;
  state["scene"] = simulation.scene().path;
  for (std::size_t hand = 0; hand < simulation::Simulation::most_hands; ++hand) {
    state["tools"][static_cast<int>(hand)] = simulation.fork(hand).tool;
  }
  const rod::ForkDofs& dofs = settings.fork.dofs;
  state["dofs"] = list({dofs.stretch ? 1.0 : 0.0, dofs.bend ? 1.0 : 0.0, dofs.torsion ? 1.0 : 0.0});
  state["stiffness"] = list(settings.fork.stiffness);
  state["damping"] = list(settings.fork.damping_ratio);
  state["damping_law"] = settings.fork.damping_law;
  state["integrator"] = settings.dynamics.integrator;
  state["step"] = settings.dynamics.step;
  state["tolerance"] = settings.dynamics.tolerance;
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

rod::PerDof read_per_family(const YAML::Node& state, const std::string& key) {
  const std::vector<double> numbers = config::read_numbers(state[key], kKey, key, 3);
  return {numbers[0], numbers[1], numbers[2]};
}

void set(simulation::Simulation& simulation, const YAML::Node& state) {
  const rod::PerDof dofs = read_per_family(state, "dofs");
  simulation.set_dofs({dofs.stretch != 0.0, dofs.bend != 0.0, dofs.torsion != 0.0});
  simulation.set_stiffness(read_per_family(state, "stiffness"));
  simulation.set_damping_ratio(read_per_family(state, "damping"),
                               config::read_string(state["damping_law"], kKey, "damping_law"));
  simulation.set_integrator(config::read_string(state["integrator"], kKey, "integrator"),
                            config::read_number(state["step"], kKey, "step", validation::positive()),
                            config::read_number(state["tolerance"], kKey, "tolerance", validation::not_negative()));
  for (std::size_t hand = 0; hand < simulation::Simulation::most_hands; ++hand) {
    simulation.select_tool(config::read_string(state["tools"][hand], kKey, "tools"), hand);
  }
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
    if (!state.IsMap() || !state["objects"].IsSequence() || !state["tools"].IsSequence()) {
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
