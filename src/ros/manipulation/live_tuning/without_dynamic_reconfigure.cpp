#include "spring_workbench/ros/manipulation/live_tuning.h"

namespace spring_workbench::manipulation {

std::unique_ptr<LiveTuning> make_live_tuning(const ros::NodeHandle&, live::SimulationRunner&) { return nullptr; }

}  // namespace spring_workbench::manipulation
