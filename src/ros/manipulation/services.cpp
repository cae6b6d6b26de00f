#include "spring_workbench/ros/manipulation/services.h"

#include <algorithm>
#include <cstdio>

#include "spring_workbench/validation/names.h"

namespace spring_workbench::manipulation {
namespace {

/// Runs the change and turns bad input into an answer.
template <typename Response, typename Change>
bool respond(Response& response, Change&& change) {
  try {
    change();
    response.success = true;
  } catch (const validation::InputError& error) {
    response.success = false;
    response.message = error.what();
    ROS_WARN_STREAM(error.what());
  }
  return true;
}

template <typename Response>
void fill(const simulation::ChangeReport& report, Response& response) {
  response.message = report.message;
  response.elastic_energy_before = report.elastic_energy_before;
  response.elastic_energy_after = report.elastic_energy_after;
}

std::string energies(const simulation::ChangeReport& report) {
  char text[80];
  std::snprintf(text, sizeof text, "; elastic energy %.6g J -> %.6g J", report.elastic_energy_before,
                report.elastic_energy_after);
  return text;
}

/// The hand of the field `stylus` (1, 2, …); none for 0.
std::optional<std::size_t> hand_of(unsigned stylus, const std::string& service) {
  constexpr std::size_t most = simulation::Simulation::most_hands;
  if (stylus > most) {
    validation::refuse(service, "stylus", std::to_string(stylus), "an integer in [0, " + std::to_string(most) + "]");
  }
  return stylus > 0 ? std::optional<std::size_t>(stylus - 1) : std::nullopt;
}

std::string describe(const dynamics::DynamicsSettings& settings) {
  char text[120];
  std::snprintf(text, sizeof text, "%s, steps of at most %g s, tolerance %g m%s",
                validation::name_of(settings.integrator).c_str(), settings.step, settings.tolerance,
                settings.tolerance > 0.0 ? "" : " (fixed steps)");
  return text;
}

}  // namespace

Services::Services(ros::NodeHandle private_node, SimulationRunner& runner, std::vector<std::string> scene_roots)
    : runner_(runner), scene_roots_(std::move(scene_roots)) {
  servers_ = {private_node.advertiseService("select_tool", &Services::select_tool, this),
              private_node.advertiseService("set_dofs", &Services::set_dofs, this),
              private_node.advertiseService("set_stiffness", &Services::set_stiffness, this),
              private_node.advertiseService("set_damping", &Services::set_damping, this),
              private_node.advertiseService("set_integrator", &Services::set_integrator, this),
              private_node.advertiseService("load_scene", &Services::load_scene, this),
              private_node.advertiseService("calibrate", &Services::calibrate, this),
              private_node.advertiseService("reset", &Services::reset, this),
              private_node.advertiseService("release", &Services::release, this)};
}

bool Services::select_tool(SelectTool::Request& request, SelectTool::Response& response) {
  return respond(response, [&] {
    const auto tool = validation::named<tools::Tool>(request.tool, "select_tool", "tool");
    const std::size_t hand = hand_of(request.stylus, "select_tool").value_or(0);
    fill(runner_.locked([&](simulation::Simulation& s) { return s.select_tool(tool, hand); }), response);
  });
}

template <typename Response>
void Services::change_fork(const simulation::ForkChange& change, std::optional<std::size_t> hand, Response& response) {
  fill(runner_.locked([&](simulation::Simulation& s) { return s.change(change, hand); }), response);
}

bool Services::set_dofs(SetForkDofs::Request& request, SetForkDofs::Response& response) {
  return respond(response, [&] {
    simulation::ForkChange change;
    change.dofs = {request.stretch != 0, request.bend != 0, request.torsion != 0};
    change_fork(change, hand_of(request.stylus, "set_dofs"), response);
  });
}

bool Services::set_stiffness(SetForkStiffness::Request& request, SetForkStiffness::Response& response) {
  return respond(response, [&] {
    const auto given = [](double k) { return k != 0.0 ? std::optional<double>(k) : std::nullopt; };
    simulation::ForkChange change;
    change.stretch_stiffness = given(request.stretch);
    change.bend_stiffness = given(request.bend);
    change.torsion_stiffness = given(request.torsion);
    change_fork(change, hand_of(request.stylus, "set_stiffness"), response);
  });
}

bool Services::set_damping(SetForkDamping::Request& request, SetForkDamping::Response& response) {
  return respond(response, [&] {
    const rod::PerDof numbers{request.stretch, request.bend, request.torsion};
    simulation::ForkChange change;
    if (!request.law.empty()) {
      change.damping_law = validation::named<rod::DampingLaw>(request.law, "set_damping", "law");
    }
    (change.damping_law == rod::DampingLaw::coefficients ? change.damping_coefficient : change.damping_ratio) = numbers;
    change_fork(change, hand_of(request.stylus, "set_damping"), response);
  });
}

bool Services::set_integrator(SetIntegrator::Request& request, SetIntegrator::Response& response) {
  return respond(response, [&] {
    simulation::DynamicsChange change;
    change.integrator = validation::named<dynamics::IntegratorKind>(request.name, "set_integrator", "name");
    if (request.step != 0.0) change.step = request.step;
    if (request.tolerance != SetIntegrator::Request::KEEP_TOLERANCE) change.tolerance = request.tolerance;
    runner_.locked([&](simulation::Simulation& s) {
      s.change(change);
      response.message = describe(s.settings().dynamics);
    });
  });
}

bool Services::load_scene(LoadScene::Request& request, LoadScene::Response& response) {
  return respond(response, [&] {
    const scene::Scene scene = spring_workbench::scene::load_scene(request.scene, scene_roots_);
    runner_.load(scene);
    response.message = scene.name + ": " + std::to_string(scene.bodies.size()) + " bodies";
    if (!scene.warnings.empty()) response.message += "; " + validation::join(scene.warnings, "; ");
  });
}

bool Services::calibrate(std_srvs::Trigger::Request&, std_srvs::Trigger::Response& response) {
  return respond(response, [&] {
    const simulation::ChangeReport report = runner_.locked([](simulation::Simulation& s) { return s.calibrate(); });
    response.message = report.message + energies(report);
  });
}

bool Services::reset(std_srvs::Trigger::Request&, std_srvs::Trigger::Response& response) {
  return respond(response, [&] {
    runner_.restart();
    response.message = "all objects are back at their start";
  });
}

bool Services::release(std_srvs::Trigger::Request&, std_srvs::Trigger::Response& response) {
  return respond(response, [&] {
    const std::string held = runner_.locked([](simulation::Simulation& s) {
      std::vector<std::string> names;
      for (std::size_t hand = 0; hand < simulation::Simulation::most_hands; ++hand) {
        const std::string name = s.fork(hand).held_object;
        if (!name.empty() && std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
      }
      s.release();
      return validation::join(names);
    });
    if (held.empty()) throw validation::InputError("release: nothing is held: must be called while an object is held");
    response.message = "released " + held;
  });
}

}  // namespace spring_workbench::manipulation
