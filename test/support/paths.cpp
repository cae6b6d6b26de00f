#include "support/paths.h"

namespace spring_workbench::test_support {

std::string checkout(const std::string& path) { return SPRING_WORKBENCH_SOURCE_DIR "/" + path; }

std::string extra_data(const std::string& path) {
  const std::string folder = SPRING_WORKBENCH_TEST_DATA;
  return folder.empty() ? "" : folder + "/" + path;
}

std::string program(const std::string& name) { return SPRING_WORKBENCH_PROGRAMS "/" + name; }

}  // namespace spring_workbench::test_support
