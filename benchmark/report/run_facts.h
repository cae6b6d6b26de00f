#pragma once

#include <string>
#include <vector>

#include "benchmark/peers.h"

namespace spring_workbench::benchmark {

/// One line about a run: what it is about, and the fact.
struct RunFact {
  std::string name;
  std::string value;
};
template <typename Fields>
void each_field(RunFact& f, Fields& fields) {
  fields(f.name, f.value);
}

/// Machine, its load now, compiler, flags, date, command, peers found and not found: what a figure must come with.
std::vector<RunFact> run_facts(const std::string& command, const Peers& peers);

/// The program's name and its arguments.
std::string command_of(int argc, char** argv);

/// What to say of run times that are measured now: empty where the load average is at most 0.5 a processor.
std::string load_warning();

/// The facts as `# name: value` lines.
std::string as_csv_header(const std::vector<RunFact>& facts);

}  // namespace spring_workbench::benchmark
