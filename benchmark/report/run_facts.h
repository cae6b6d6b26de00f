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

/// Machine, its load now, compiler, flags, date, command, peers found and not found: what a figure must come with.
std::vector<RunFact> run_facts(int argc, char** argv, const Peers& peers);

/// The facts as `# name: value` lines.
std::string as_csv_header(const std::vector<RunFact>& facts);

}  // namespace spring_workbench::benchmark
