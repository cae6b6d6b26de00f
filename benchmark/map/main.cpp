// stability_map --out FOLDER [--full [--cells N]]
//
// The stability map alone: the cells that the report draws, or the full product of their values. The latter continues
// from the cells in FOLDER/full.tsv, with at most N more.
#include <filesystem>
#include <fstream>
#include <iostream>
#include <limits>
#include <map>

#include "benchmark/full_map.h"
#include "spring_workbench/dynamics/integrator.h"
#include "spring_workbench/validation/input_error.h"
#include "spring_workbench/validation/names.h"
#include "spring_workbench/validation/number_rule.h"

namespace {

using namespace spring_workbench;
using namespace spring_workbench::benchmark;

struct Options {
  std::string out;
  bool full = false;
  std::size_t cells = std::numeric_limits<std::size_t>::max();
};

Options parse(int argc, char** argv) {
  constexpr const char* kWhere = "command line";
  Options options;
  for (int i = 1; i < argc; ++i) {
    const std::string argument = argv[i], value = i + 1 < argc ? argv[i + 1] : "";
    if (argument == "--full") {
      options.full = true;
    } else if (argument == "--out") {
      if (value.empty()) validation::refuse(kWhere, "--out", value, "a folder to write to");
      options.out = value;
      ++i;
    } else if (argument == "--cells") {
      if (value.empty() || value.size() > 9 || value.find_first_not_of("0123456789") != std::string::npos)
        validation::refuse(kWhere, "--cells", value, "a number of cells from 0 to 999999999");
      options.cells = std::stoul(value);
      ++i;
    } else {
      throw validation::InputError(validation::prefix(kWhere, argument) +
                                   "unknown option; known options are --out DIR, --full, --cells N");
    }
  }
  if (options.out.empty()) validation::refuse_missing(kWhere, "--out", "folder to write to");
  return options;
}

/// Plan for the integrators made for stiff forks.
StabilityPlan full_plan() {
  StabilityPlan plan = stability_plan(false);
  std::vector<std::string> stiff;
  for (const std::string& name : plan.integrators) {
    const auto kind = validation::named<dynamics::IntegratorKind>(name, "map", "integrator");
    if (dynamics::make_integrator(kind)->stiffly_stable()) stiff.push_back(name);
  }
  plan.integrators = stiff;
  return plan;
}

StabilityMap drawn_map() {
  const StabilityPlan plan = stability_plan(false);
  Progress progress(std::cerr, false, unit_count(plan));
  Units units(progress, Shard{});
  return stability_map(plan, units);
}

void write(const StabilityMap& map, const std::string& folder) {
  std::ofstream(folder + "/stability_map.csv") << stability_csv(map);
  std::ofstream(folder + "/stability_failures.csv") << failures_csv(map);
  std::map<std::string, std::pair<long, long>> held;
  for (const StabilityRow& row : map.rows) {
    held[row.integrator].first += row.held;
    held[row.integrator].second += row.cells;
  }
  for (const auto& [integrator, counts] : held)
    std::cout << integrator << ": " << counts.first << " of " << counts.second << " cells that can fail hold\n";
}

}  // namespace

int main(int argc, char** argv) {
  try {
    const Options options = parse(argc, argv);
    std::filesystem::create_directories(options.out);
    if (options.full) {
      const StabilityPlan plan = full_plan();
      const auto cells = run_full_map(plan, options.out + "/full.tsv", options.cells, std::cerr);
      std::cout << cells.size() << " of " << full_map_size(plan) << " cells have been run\n";
      write(map_of(cells), options.out);
    } else {
      write(drawn_map(), options.out);
    }
    return 0;
  } catch (const validation::InputError& error) {
    std::cerr << "stability_map: " << error.what() << '\n';
    return 2;
  } catch (const std::exception& error) {
    std::cerr << "stability_map: " << error.what() << '\n';
    return 1;
  }
}
