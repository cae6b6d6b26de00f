#include "spring_workbench/ros/services/services.h"

#include <std_srvs/Trigger.h>

#include <cstdio>

#include "spring_workbench/Calibrate.h"
#include "spring_workbench/EditObject.h"
#include "spring_workbench/LoadScene.h"
#include "spring_workbench/Release.h"
#include "spring_workbench/SaveScene.h"
#include "spring_workbench/SelectTool.h"
#include "spring_workbench/SetClutch.h"
#include "spring_workbench/SetForkDamping.h"
#include "spring_workbench/SetForkDofs.h"
#include "spring_workbench/SetForkStiffness.h"
#include "spring_workbench/SetIntegrator.h"
#include "spring_workbench/ros/common/conversions.h"
#include "spring_workbench/scene/editing.h"
#include "spring_workbench/validation/names.h"

namespace spring_workbench::services {
namespace {

template <typename Response>
void fill(const simulation::ChangeReport& report, Response& response) {
  response.message = report.message;
  response.elastic_energy_before = report.elastic_energy_before;
  response.elastic_energy_after = report.elastic_energy_after;
  response.energy_added = report.energy_added;
}

/// For a response that has no field for the energy.
std::string with_energy(const std::string& message, const simulation::ChangeReport& report) {
  char text[50];
  std::snprintf(text, sizeof text, "; energy added: %.9g J", report.energy_added);
  return message + text;
}

/// `stylus`: 1, 2, …; 0: all.
live::Command command_of(const live::SimulationRunner& runner, live::Command::Kind kind, unsigned stylus) {
  if (stylus > runner.hands()) {
    validation::refuse("", "stylus", std::to_string(stylus),
                       "an integer between 0 and " + std::to_string(runner.hands()));
  }
  live::Command command;
  command.kind = kind;
  if (stylus > 0) command.hand = stylus - 1;
  return command;
}

void select_tool(live::SimulationRunner& runner, const SelectTool::Request& request, SelectTool::Response& response) {
  const auto tool = validation::named<tools::Tool>(request.tool, "", "tool");
  live::Command command = command_of(runner, live::Command::Kind::select_tool, request.stylus);
  command.tool = tool;
  fill(runner.change("select_tool", command), response);
}

template <typename Response>
void change_fork(live::SimulationRunner& runner, const simulation::ForkChange& change, unsigned stylus,
                 const std::string& service, Response& response) {
  live::Command command = command_of(runner, live::Command::Kind::settings, stylus);
  command.fork_change = change;
  fill(runner.change(service, command), response);
}

void set_dofs(live::SimulationRunner& runner, const SetForkDofs::Request& request, SetForkDofs::Response& response) {
  simulation::ForkChange change;
  change.dofs = {request.stretch != 0, request.bend != 0, request.torsion != 0};
  change_fork(runner, change, request.stylus, "set_dofs", response);
}

void set_stiffness(live::SimulationRunner& runner, const SetForkStiffness::Request& request,
                   SetForkStiffness::Response& response) {
  const auto given = [](double k) { return k != 0.0 ? std::optional<double>(k) : std::nullopt; };
  simulation::ForkChange change;
  change.stiffness = {given(request.stretch), given(request.bend), given(request.torsion)};
  change_fork(runner, change, request.stylus, "set_stiffness", response);
}

void set_damping(live::SimulationRunner& runner, const SetForkDamping::Request& request,
                 SetForkDamping::Response& response) {
  simulation::ForkChange change;
  change.damping = {request.stretch, request.bend, request.torsion};
  if (!request.law.empty()) change.damping_law = validation::named<rod::DampingLaw>(request.law, "", "law");
  change_fork(runner, change, request.stylus, "set_damping", response);
}

void set_integrator(live::SimulationRunner& runner, const SetIntegrator::Request& request,
                    SetIntegrator::Response& response) {
  live::Command command;
  command.kind = live::Command::Kind::settings;
  simulation::DynamicsChange& change = command.dynamics_change;
  change.integrator = validation::named<dynamics::IntegratorKind>(request.name, "", "name");
  if (request.step != 0.0) change.step = request.step;
  if (request.tolerance != SetIntegrator::Request::KEEP_TOLERANCE) change.tolerance = request.tolerance;
  fill(runner.change("set_integrator", command), response);
  const dynamics::DynamicsSettings now =
      runner.locked([](const simulation::Simulation& s) { return s.settings().dynamics; });
  const live::StepTime step = runner.time_of_step();
  const bool fixed = !(now.tolerance > 0.0);
  char text[200];
  std::snprintf(text, sizeof text, "%s, steps of at most %g s%s; a step takes %.3g ms now%s",
                validation::name_of(now.integrator).c_str(), now.step,
                fixed ? ", no tolerance" : (", tolerance " + validation::number_text(now.tolerance) + " m").c_str(),
                1e3 * step.takes, step.takes > step.lasts ? ": slower than real time, so samples will be dropped" : "");
  response.message = text;
}

void load_scene(live::SimulationRunner& runner, const std::vector<std::string>& roots,
                const LoadScene::Request& request, LoadScene::Response& response) {
  const scene::Scene scene = scene::load_scene(request.scene, roots);
  fill(runner.load(scene), response);
  response.message = scene.name + ": " + std::to_string(scene.bodies.size()) + " bodies";
  if (!scene.warnings.empty()) response.message += "; " + validation::join(scene.warnings, "; ");
}

void edit_object(live::SimulationRunner& runner, const std::vector<std::string>& roots,
                 const EditObject::Request& request, EditObject::Response& response) {
  using Action = simulation::ObjectEdit::Action;
  live::Command command;
  command.kind = live::Command::Kind::edit;
  command.roots = roots;
  simulation::ObjectEdit& edit = command.edit;
  edit.action = validation::named<Action>(request.action, "", "action");
  edit.name = request.name;
  const geometry_msgs::Quaternion& q = request.pose.orientation;
  const bool given = q.x != 0.0 || q.y != 0.0 || q.z != 0.0 || q.w != 0.0;
  if (edit.action == Action::add) edit.urdf = request.urdf;
  if (given && (edit.action == Action::add || edit.action == Action::move)) {
    edit.X_WL = ros_common::from_message(request.pose);
  }
  if (edit.action == Action::mass) edit.mass = request.mass;
  if (edit.action == Action::friction) edit.friction = request.friction;
  fill(runner.change("edit_object", command), response);
}

void save_scene(live::SimulationRunner& runner, const std::vector<std::string>& roots,
                const SaveScene::Request& request, SaveScene::Response& response) {
  const scene::Scene scene = runner.committed([](const live::Progress&) { return true; })->view.present_scene();
  response.message = "wrote " + scene::save_scene(scene, request.path, roots) + " and the YAML file next to it";
}

void calibrate(live::SimulationRunner& runner, const Calibrate::Request& request, Calibrate::Response& response) {
  fill(runner.change("calibrate", command_of(runner, live::Command::Kind::calibrate, request.stylus)), response);
}

void set_clutch(live::SimulationRunner& runner, const SetClutch::Request& request, SetClutch::Response& response) {
  live::Command command = command_of(runner, live::Command::Kind::clutch, request.stylus);
  command.on = request.on != 0;
  fill(runner.change("clutch", command), response);
}

void release(live::SimulationRunner& runner, const Release::Request& request, Release::Response& response) {
  const live::Command command = command_of(runner, live::Command::Kind::release, request.stylus);
  fill(runner.change("release", command), response);
}

}  // namespace

std::vector<ros::ServiceServer> advertise_services(ros::NodeHandle node, live::SimulationRunner& runner,
                                                   const std::vector<std::string>& scene_roots) {
  std::vector<ros::ServiceServer> servers;
  const auto serve = [&](const char* name, auto change, auto of_service) {
    using Service = decltype(of_service);
    using Request = typename Service::Request;
    using Response = typename Service::Response;
    servers.push_back(node.advertiseService<Request, Response>(name, [=](Request& request, Response& response) {
      try {
        change(request, response);
        response.success = true;
      } catch (const validation::InputError& error) {
        response.success = false;
        response.message = std::string(name) + ": " + error.what();
        ROS_WARN_STREAM(response.message);
      }
      return true;
    }));
  };
  const auto change = [&](const char* name, auto make_change, auto of_service) {
    const auto with_runner = [&runner, make_change](auto& request, auto& response) {
      make_change(runner, request, response);
    };
    serve(name, with_runner, of_service);
  };
  change("select_tool", select_tool, SelectTool());
  change("set_dofs", set_dofs, SetForkDofs());
  change("set_stiffness", set_stiffness, SetForkStiffness());
  change("set_damping", set_damping, SetForkDamping());
  change("set_integrator", set_integrator, SetIntegrator());
  const auto with_files = [&](const char* name, auto make, auto of_service) {
    serve(
        name,
        [&runner, scene_roots, make](auto& request, auto& response) { make(runner, scene_roots, request, response); },
        of_service);
  };
  with_files("load_scene", load_scene, LoadScene());
  with_files("edit_object", edit_object, EditObject());
  with_files("save_scene", save_scene, SaveScene());
  change("calibrate", calibrate, Calibrate());
  change("release", release, Release());
  change("clutch", set_clutch, SetClutch());
  const auto reset = [&runner](auto&, auto& response) {
    response.message = with_energy("all objects are back at their start poses", runner.restart());
  };
  serve("reset", reset, std_srvs::Trigger());
  const auto undo = [&runner](auto&, auto& response) {
    const simulation::ChangeReport report = runner.undo();
    response.message = with_energy("undone: " + report.message, report);
  };
  serve("undo", undo, std_srvs::Trigger());
  return servers;
}

}  // namespace spring_workbench::services
