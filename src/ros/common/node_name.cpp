#include "spring_workbench/ros/common/node_name.h"

#include <ros/names.h>

#include "spring_workbench/validation/number_rule.h"

namespace spring_workbench::ros_common {

NodeName::NodeName(const std::string& name) : name_(name) {
  std::string error;
  const bool ends = name.empty() || name.back() == '/';
  if (ends || name.front() == '~' || !ros::names::validate(name, error))
    validation::refuse("node", "name", name, "the name of a ROS node");
}

std::string NodeName::in_namespace(const std::string& name) const {
  return ros::names::append(ros::names::parentNamespace(ros::names::resolve(name_)), name);
}

}  // namespace spring_workbench::ros_common
