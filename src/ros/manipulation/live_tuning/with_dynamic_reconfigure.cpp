#include <dynamic_reconfigure/server.h>

#include "spring_workbench/ManipulationConfig.h"
#include "spring_workbench/ros/manipulation/live_tuning.h"
#include "spring_workbench/validation/input_error.h"

namespace spring_workbench::manipulation {
namespace {

/// What the simulation has now.
void take_from(const simulation::SimulationSettings& settings, ManipulationConfig& config) {
  const rod::ForkSettings& fork = settings.fork;
  config.stretch = fork.dofs.stretch;
  config.bend = fork.dofs.bend;
  config.torsion = fork.dofs.torsion;
  config.stretch_stiffness = fork.stiffness.stretch;
  config.bend_stiffness = fork.stiffness.bend;
  config.torsion_stiffness = fork.stiffness.torsion;
  config.stretch_damping = fork.damping_ratio.stretch;
  config.bend_damping = fork.damping_ratio.bend;
  config.torsion_damping = fork.damping_ratio.torsion;
  config.integrator = settings.dynamics.integrator;
  config.step = settings.dynamics.step;
}

bool same(const rod::PerDof& a, const rod::PerDof& b) {
  return a.stretch == b.stretch && a.bend == b.bend && a.torsion == b.torsion;
}

/// Makes the changes that the configuration asks for, one after the other. Throws InputError at the first bad one.
void give_to(simulation::Simulation& simulation, const ManipulationConfig& config) {
  const rod::ForkSettings fork = simulation.settings().fork;
  const rod::ForkDofs dofs{config.stretch, config.bend, config.torsion};
  const rod::PerDof stiffness{config.stretch_stiffness, config.bend_stiffness, config.torsion_stiffness};
  const rod::PerDof damping{config.stretch_damping, config.bend_damping, config.torsion_damping};
  const dynamics::DynamicsSettings dynamics = simulation.settings().dynamics;
  if (!(dofs == fork.dofs)) simulation.set_dofs(dofs);
  if (!same(stiffness, fork.stiffness)) simulation.set_stiffness(stiffness);
  if (!same(damping, fork.damping_ratio)) {
    const bool one_ratio = same(damping, {damping.stretch, damping.stretch, damping.stretch});
    simulation.set_damping_ratio(damping, one_ratio ? "" : "per_dof");  // the modal law knows one ratio alone
  }
  if (config.integrator != dynamics.integrator || config.step != dynamics.step) {
    simulation.set_integrator(config.integrator, config.step);
  }
}

bool same(const ManipulationConfig& a, const ManipulationConfig& b) { return a.__level__(b) == 0; }

class Reconfigure final : public LiveTuning {
 public:
  Reconfigure(const ros::NodeHandle& private_node, SimulationRunner& runner)
      : runner_(runner), node_(private_node, "live"), server_(mutex_, node_) {
    server_.setCallback([this](ManipulationConfig& config, uint32_t level) { on_change(config, level); });
    follow_timer_ = node_.createWallTimer(ros::WallDuration(0.2), [this](const ros::WallTimerEvent&) { follow(); });
  }

 private:
  static constexpr uint32_t at_start = ~uint32_t{0};  ///< the server's level for what it read from old parameters

  void on_change(ManipulationConfig& config, uint32_t level) {
    runner_.locked([&](simulation::Simulation& simulation) {
      try {
        if (level != at_start) give_to(simulation, config);
      } catch (const validation::InputError& error) {
        ROS_WARN_STREAM(error.what());
      }
      take_from(simulation.settings(), config);
    });
    told_ = config;
  }

  /// Tells what others have changed.
  void follow() {
    ManipulationConfig now = told_;
    runner_.locked([&](const simulation::Simulation& simulation) { take_from(simulation.settings(), now); });
    if (same(now, told_)) return;
    told_ = now;
    server_.updateConfig(now);
  }

  SimulationRunner& runner_;
  ros::NodeHandle node_;
  boost::recursive_mutex mutex_;
  dynamic_reconfigure::Server<ManipulationConfig> server_;
  ManipulationConfig told_;
  ros::WallTimer follow_timer_;
};

}  // namespace

std::unique_ptr<LiveTuning> make_live_tuning(const ros::NodeHandle& private_node, SimulationRunner& runner) {
  return std::make_unique<Reconfigure>(private_node, runner);
}

}  // namespace spring_workbench::manipulation
