#pragma once

#include <string>
#include <vector>

#include "benchmark/baselines.h"

namespace spring_workbench::benchmark {

/// A fact about a run: its name and value.
struct RunFact {
  std::string name;
  std::string value;
};
template <typename Fields>
void each_field(RunFact& f, Fields& fields) {
  fields(f.name, f.value);
}

/// Machine, its current load, compiler, flags, date, command, commit, baselines found and not found: what must
/// accompany every number.
std::vector<RunFact> run_facts(const std::string& command, const std::string& commit, const Baselines& baselines);

/// The program's name and its arguments.
std::string command_of(int argc, char** argv);

/// Warning about run times measured now; empty if the load average is at most 0.5 per processor.
std::string load_warning();

/// The facts as `# name: value` lines.
std::string as_csv_header(const std::vector<RunFact>& facts);

}  // namespace spring_workbench::benchmark
