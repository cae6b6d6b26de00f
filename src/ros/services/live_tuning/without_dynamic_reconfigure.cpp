#include "spring_workbench/ros/services/live_tuning.h"

namespace spring_workbench::services {

std::unique_ptr<LiveTuning> make_live_tuning(const ros::NodeHandle&, live::SimulationRunner&) { return nullptr; }

}  // namespace spring_workbench::services
