#include "../motion.h"
#include "spring_workbench/validation/input_error.h"

namespace spring_workbench::replay {
namespace {

[[noreturn]] void refuse_bag() {
  throw validation::InputError(
      "command line: --bag: this replay was built without ROS and cannot read bags; use --motion");
}

}  // namespace

std::map<std::size_t, Motion> read_bag(const std::string&, const std::string&, const std::string&, int) {
  refuse_bag();
}

std::vector<live::Entry> read_journal(const std::string&) { refuse_bag(); }

}  // namespace spring_workbench::replay
