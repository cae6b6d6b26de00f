// scene_errors METHOD...
//
// Error against run time of the named methods alone in the scenes of the report, as a table on standard output: columns
// of error_table.csv.
#include <unistd.h>

#include <algorithm>
#include <iostream>
#include <optional>

#include "benchmark/baselines.h"
#include "benchmark/error_table.h"
#include "benchmark/our_methods.h"
#include "spring_workbench/config/command_line.h"
#include "spring_workbench/validation/number_rule.h"

namespace {

using namespace spring_workbench;
using namespace spring_workbench::benchmark;

std::vector<const Method*> named(const std::vector<std::string>& names, const std::vector<MethodPtr>& all) {
  std::vector<const Method*> methods;
  for (const std::string& name : names) {
    const auto method = std::find_if(all.begin(), all.end(), [&](const MethodPtr& m) { return m->name() == name; });
    if (method == all.end()) validation::refuse(config::command_line, "METHOD", name, "a method of this build");
    methods.push_back(method->get());
  }
  return methods;
}

void measure(const std::vector<std::string>& names) {
  std::vector<MethodPtr> all = our_methods();
  Baselines baselines = all_baselines();
  std::move(baselines.methods.begin(), baselines.methods.end(), std::back_inserter(all));
  const std::vector<const Method*> methods = named(names, all);
  const ErrorTablePlan plan = error_table_plan(false);
  Progress progress(std::cerr, isatty(STDERR_FILENO) != 0, unit_count(plan));
  Units units(progress, Shard{});
  const std::vector<ErrorRow> rows = error_table(methods, plan, units);
  progress.finish();
  std::cout << "# baselines found:";
  for (const std::string& found : baselines.found)
    std::cout << (&found == &baselines.found.front() ? " " : ", ") << found;
  std::cout << '\n' << as_csv(rows);
}

std::optional<std::vector<std::string>> parse(int argc, char** argv) {
  std::vector<std::string> names(argv + 1, argv + argc);
  if (std::find(names.begin(), names.end(), "--help") != names.end()) return std::nullopt;
  if (names.empty()) validation::refuse(config::command_line, "METHOD", "names of methods of the report");
  return names;
}

}  // namespace

int main(int argc, char** argv) {
  return config::run_program(
      "scene_errors", "Usage: scene_errors METHOD...\nError against run time of these methods in scenes A, B, C.\n",
      [&] { return parse(argc, argv); }, &measure);
}
