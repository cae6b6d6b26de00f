#include "benchmark/report/options.h"

#include <unistd.h>

#include <cstdio>
#include <filesystem>

#include "spring_workbench/validation/number_rule.h"

namespace spring_workbench::benchmark {
namespace {

constexpr const char* kWhere = "command line";

Shard shard_of(const std::string& text) {
  constexpr std::size_t kMax = 10000;
  Shard shard;
  char slash = 0, rest = 0;
  const bool digits = text.find_first_not_of("0123456789/") == std::string::npos && text.size() < 12;
  if (!digits || std::sscanf(text.c_str(), "%zu%c%zu%c", &shard.index, &slash, &shard.count, &rest) != 3 ||
      slash != '/' || shard.index < 1 || shard.index > shard.count || shard.count > kMax) {
    validation::refuse(kWhere, "--shard", text, "I/N with 1 <= I <= N <= 10000");
  }
  return shard;
}

/// The option that takes the path after an argument about a recording; null for other arguments.
std::string* path_of_recording(const std::string& argument, ReportOptions& options) {
  if (argument == "--scene") return &options.scene;
  if (argument == "--bag") return &options.bag;
  if (argument == "--settings") return &options.settings;
  if (argument == "--motion") return &options.motions.emplace_back();
  return nullptr;
}

void check_recording(const ReportOptions& options) {
  if (options.scene.empty() != (options.bag.empty() && options.motions.empty())) {
    validation::refuse(kWhere, "--scene, --bag, --motion", "one without the other",
                       "a scene together with a bag or motions");
  }
  if (options.scene.empty() && !options.settings.empty())
    validation::refuse(kWhere, "--settings", options.settings, "given together with --scene");
  if (options.of_recording() && (options.shard || !options.parts.empty()))
    validation::refuse(kWhere, "--scene", "both", "given without --shard and --merge");
}

}  // namespace

ReportOptions parse_report_options(int argc, char** argv) {
  ReportOptions options;
  bool has_out = false;
  for (int i = 1; i < argc; ++i) {
    const std::string argument = argv[i];
    const bool has_value = i + 1 < argc && *argv[i + 1] != '\0';
    if (argument == "--quick") {
      options.quick = true;
    } else if (argument == "--out") {
      if (!has_value) validation::refuse(kWhere, "--out", "", "a folder to write to");
      options.out = argv[++i];
      has_out = true;
    } else if (std::string* field = path_of_recording(argument, options)) {
      if (!has_value) validation::refuse(kWhere, argument, "", "a path");
      *field = argv[++i];
    } else if (argument == "--shard") {
      options.shard = shard_of(has_value ? argv[++i] : "");
    } else if (argument == "--commit") {
      if (!has_value) validation::refuse(kWhere, "--commit", "", "the name of a commit");
      options.commit = argv[++i];
    } else if (argument == "--queue") {
      if (!has_value) validation::refuse(kWhere, "--queue", "", "a folder that all shards share, empty at first");
      options.queue = argv[++i];
    } else if (argument == "--merge") {
      if (!has_value) validation::refuse(kWhere, "--merge", "", "the files of all shards");
      while (i + 1 < argc && std::string(argv[i + 1]).rfind("--", 0) != 0) options.parts.emplace_back(argv[++i]);
    } else {
      throw validation::InputError(validation::prefix(kWhere, argument) +
                                   "unknown option; known options are --quick, --out DIR, --commit NAME, --shard I/N, "
                                   "--queue DIR, --merge PART..., --scene FILE, --bag FILE, --motion FILE, "
                                   "--settings FILE");
    }
  }
  check_recording(options);
  if (options.shard && has_out)
    validation::refuse(kWhere, "--shard, --out", "both",
                       "given one without the other, since a shard goes to the standard output");
  if (!options.queue.empty() && !options.shard)
    validation::refuse(kWhere, "--queue", options.queue, "given together with --shard");
  if (!options.parts.empty() && (options.shard || options.quick)) {
    validation::refuse(kWhere, "--merge", "both", "given without --shard and --quick, which the files name");
  }
  return options;
}

void make_folder(const std::string& folder) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (!std::filesystem::is_directory(folder, error) || access(folder.c_str(), W_OK | X_OK) != 0) {
    validation::refuse(kWhere, "--out", folder, "a folder that can be created and written to");
  }
}

}  // namespace spring_workbench::benchmark
