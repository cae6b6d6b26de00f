#include "../motion.h"
#include "spring_workbench/validation/number_rule.h"

namespace spring_workbench::replay {

std::vector<Motion> read_bag(const std::string& path, const std::string&, const std::string&, int) {
  validation::refuse("command line", "--bag", path, "given to a build with ROS, which this one is not");
}

std::vector<live::Entry> read_journal(const std::string& path) {
  validation::refuse("command line", "--bag", path, "given to a build with ROS, which this one is not");
}

}  // namespace spring_workbench::replay
