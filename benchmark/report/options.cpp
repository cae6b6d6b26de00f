#include "benchmark/report/options.h"

#include <unistd.h>

#include <filesystem>

#include "spring_workbench/config/yaml_fields.h"

namespace spring_workbench::benchmark {
namespace {

constexpr const char* kWhere = "command line";

void make_folder(const std::string& folder) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (!std::filesystem::is_directory(folder, error) || access(folder.c_str(), W_OK | X_OK) != 0) {
    refuse(kWhere, "--out", folder, "a folder that can be made and written to");
  }
}

}  // namespace

ReportOptions parse_report_options(int argc, char** argv) {
  ReportOptions options;
  for (int i = 1; i < argc; ++i) {
    const std::string argument = argv[i];
    if (argument == "--quick") {
      options.quick = true;
    } else if (argument == "--out") {
      if (i + 1 == argc || *argv[i + 1] == '\0') refuse(kWhere, "--out", "(nothing)", "a folder to write to");
      options.out = argv[++i];
    } else {
      refuse(kWhere, "argument", argument, "one of --quick, --out DIR");
    }
  }
  make_folder(options.out);
  return options;
}

}  // namespace spring_workbench::benchmark
