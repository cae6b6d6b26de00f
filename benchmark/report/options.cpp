#include "benchmark/report/options.h"

#include <unistd.h>

#include <cstdio>
#include <filesystem>

#include "spring_workbench/validation/number_rule.h"

namespace spring_workbench::benchmark {
namespace {

constexpr const char* kWhere = "command line";
constexpr const char* kShard = "I/N with 1 <= I <= N <= 10000";

Shard shard_of(const std::string& text) {
  constexpr std::size_t kMax = 10000;
  Shard shard;
  char slash = 0, rest = 0;
  const bool digits = text.find_first_not_of("0123456789/") == std::string::npos && text.size() < 12;
  if (!digits || std::sscanf(text.c_str(), "%zu%c%zu%c", &shard.index, &slash, &shard.count, &rest) != 3 ||
      slash != '/' || shard.index < 1 || shard.index > shard.count || shard.count > kMax) {
    validation::refuse(kWhere, "--shard", text, kShard);
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

[[noreturn]] void refuse_together(const std::string& options, const std::string& reason) {
  throw validation::InputError(validation::prefix(kWhere, options) + reason);
}

void check_recording(const ReportOptions& options) {
  if (options.scene.empty() != (options.bag.empty() && options.motions.empty()))
    validation::refuse(kWhere, "--scene, --bag, --motion", "a scene together with a bag or motions");
  if (options.scene.empty() && !options.settings.empty())
    refuse_together("--settings", "can only be given together with --scene");
  if (options.of_recording() && (options.shard || !options.parts.empty()))
    refuse_together("--scene", "cannot be given together with --shard or --merge");
}

}  // namespace

std::optional<ReportOptions> parse_report_options(int argc, char** argv) {
  ReportOptions options;
  bool has_out = false;
  for (int i = 1; i < argc; ++i) {
    const std::string argument = argv[i];
    const auto value = [&](const std::string& rule) {
      if (i + 1 >= argc || *argv[i + 1] == '\0') validation::refuse(kWhere, argument, rule);
      return std::string(argv[++i]);
    };
    if (argument == "--help" || argument == "-h") return std::nullopt;
    if (argument == "--quick") {
      options.quick = true;
    } else if (argument == "--out") {
      options.out = value("a folder to write to");
      has_out = true;
    } else if (std::string* field = path_of_recording(argument, options)) {
      *field = value("a path");
    } else if (argument == "--shard") {
      options.shard = shard_of(value(kShard));
    } else if (argument == "--commit") {
      options.commit = value("the name of a commit");
    } else if (argument == "--queue") {
      options.queue = value("a folder that all shards share, empty at first");
    } else if (argument == "--merge") {
      options.parts.push_back(value("the files of all shards"));
      while (i + 1 < argc && std::string(argv[i + 1]).rfind("--", 0) != 0) options.parts.emplace_back(argv[++i]);
    } else {
      throw validation::InputError(validation::prefix(kWhere, argument) + "unknown option; --help lists all options");
    }
  }
  check_recording(options);
  if (options.shard && has_out)
    refuse_together("--shard, --out", "cannot be given together, since a shard goes to the standard output");
  if (!options.queue.empty() && !options.shard) refuse_together("--queue", "can only be given together with --shard");
  if (!options.parts.empty() && (options.shard || options.quick))
    refuse_together("--merge", "cannot be given together with --shard or --quick, which the files name");
  return options;
}

std::string report_help() {
  return R"(Measures error against run time of the integrators, the shape models and the baselines that were found, and
the stability map; or the integrators on a recording of yours.

report [--quick] [--out DIR] [--commit NAME]
report [--quick] [--out DIR] [--commit NAME] --scene SCENE.urdf (--bag FILE.bag | --motion FILE [--motion FILE ...])
       [--settings FILE.yaml]
report [--quick] [--commit NAME] --shard I/N [--queue DIR] > PART
report [--out DIR] --merge PART [PART ...]

  --quick     few scenes, settings and cells of the stability map: some minutes
  --out       the folder to write to; default report
  --commit    the commit that the program was built from, for the headers of the tables
  --scene, --bag, --motion, --settings  a recording of yours and its settings, as for replay
  --shard     measure only part I of N, and write the results to the standard output; all parts are then merged
  --queue     a folder that all shards share, empty at first: each shard takes the next unit from it
  --merge     the files of all shards

Writes tables (CSV), pictures (PNG), one page (report.html), and prints the checks. Exit status: 0 done; 1 failed; 2
bad arguments or input, with one line on standard error.
)";
}

void make_folder(const std::string& folder) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (!std::filesystem::is_directory(folder, error) || access(folder.c_str(), W_OK | X_OK) != 0) {
    validation::refuse(kWhere, "--out", folder, "a folder that can be created and written to");
  }
}

}  // namespace spring_workbench::benchmark
