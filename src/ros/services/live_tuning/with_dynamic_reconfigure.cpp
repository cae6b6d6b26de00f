#include <dynamic_reconfigure/server.h>

#include "spring_workbench/ManipulationConfig.h"
#include "spring_workbench/ros/services/live_tuning.h"
#include "spring_workbench/validation/names.h"

namespace spring_workbench::services {
namespace {

/// Copies the current settings of the simulation, with those of the first hand's fork.
void take_from(const simulation::Simulation& simulation, ManipulationConfig& config) {
  const rod::ForkSettings& fork = simulation.fork_settings();
  config.stretch = fork.dofs.stretch;
  config.bend = fork.dofs.bend;
  config.torsion = fork.dofs.torsion;
  config.stretch_stiffness = fork.stiffness.stretch;
  config.bend_stiffness = fork.stiffness.bend;
  config.torsion_stiffness = fork.stiffness.torsion;
  config.stretch_damping = fork.damping().stretch;
  config.bend_damping = fork.damping().bend;
  config.torsion_damping = fork.damping().torsion;
  config.integrator = validation::name_of(simulation.settings().dynamics.integrator);
  config.step = simulation.settings().dynamics.step;
}

template <typename T>
std::optional<T> if_other(const T& asked, const T& present) {
  return asked == present ? std::nullopt : std::optional<T>(asked);
}

/// The change of all forks that the configuration requests. Throws InputError if it is invalid.
live::Command command_for(const simulation::Simulation& simulation, const ManipulationConfig& config) {
  const rod::ForkSettings& fork = simulation.fork_settings();
  const dynamics::DynamicsSettings& dynamics = simulation.settings().dynamics;
  live::Command command;
  command.kind = live::Command::Kind::settings;
  simulation::ForkChange& fork_change = command.fork_change;
  fork_change.dofs = {if_other(config.stretch, fork.dofs.stretch), if_other(config.bend, fork.dofs.bend),
                      if_other(config.torsion, fork.dofs.torsion)};
  fork_change.stiffness = {if_other(config.stretch_stiffness, fork.stiffness.stretch),
                           if_other(config.bend_stiffness, fork.stiffness.bend),
                           if_other(config.torsion_stiffness, fork.stiffness.torsion)};
  fork_change.damping = {if_other(config.stretch_damping, fork.damping().stretch),
                         if_other(config.bend_damping, fork.damping().bend),
                         if_other(config.torsion_damping, fork.damping().torsion)};
  simulation::DynamicsChange& dynamics_change = command.dynamics_change;
  dynamics_change.integrator =
      if_other(validation::named<dynamics::IntegratorKind>(config.integrator, "", "integrator"), dynamics.integrator);
  dynamics_change.step = if_other(config.step, dynamics.step);
  return command;
}

bool same(const ManipulationConfig& a, const ManipulationConfig& b) { return a.__level__(b) == 0; }

class Reconfigure final : public LiveTuning {
 public:
  Reconfigure(const ros::NodeHandle& private_node, live::SimulationRunner& runner)
      : runner_(runner), node_(private_node, "live"), server_(mutex_, node_) {
    server_.setCallback([this](ManipulationConfig& config, uint32_t level) { on_change(config, level); });
    follow_timer_ = node_.createSteadyTimer(ros::WallDuration(0.2), [this](const ros::SteadyTimerEvent&) { follow(); });
  }

 private:
  static constexpr uint32_t at_start = ~uint32_t{0};  ///< level with which the server reports old parameters

  void on_change(ManipulationConfig& config, uint32_t level) {
    try {
      if (level != at_start) {
        runner_.change("live", runner_.locked([&](const auto& present) { return command_for(present, config); }));
      }
    } catch (const validation::InputError& error) {
      ROS_WARN_STREAM("dynamic_reconfigure: " << error.what());
    }
    runner_.locked([&](const simulation::Simulation& simulation) { take_from(simulation, config); });
    published_ = config;
  }

  /// Reports changes that were made elsewhere.
  void follow() {
    ManipulationConfig now = published_;
    runner_.locked([&](const simulation::Simulation& simulation) { take_from(simulation, now); });
    if (same(now, published_)) return;
    published_ = now;
    server_.updateConfig(now);
  }

  live::SimulationRunner& runner_;
  ros::NodeHandle node_;
  boost::recursive_mutex mutex_;
  dynamic_reconfigure::Server<ManipulationConfig> server_;
  ManipulationConfig published_;
  ros::SteadyTimer follow_timer_;
};

}  // namespace

std::unique_ptr<LiveTuning> make_live_tuning(const ros::NodeHandle& private_node, live::SimulationRunner& runner) {
  return std::make_unique<Reconfigure>(private_node, runner);
}

}  // namespace spring_workbench::services
