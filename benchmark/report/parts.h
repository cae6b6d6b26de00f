#pragma once

#include <ostream>
#include <string>
#include <vector>

#include "benchmark/report/run_facts.h"
#include "benchmark/units.h"

namespace spring_workbench::benchmark {

/// Run time of a report or of one of its shards.
struct RunTime {
  double begun = 0.0, ended = 0.0;  ///< wall clock [s]
  double processor = 0.0;           ///< of all its processes [s]
};

/// The current time, and the processor time of this process and its children so far; `begun` is 0.
RunTime run_time_now();

/// Results of one shard of a report, or of all of them.
struct ReportPart {
  Shard shard;
  bool quick = false;
  RunTime time;
  std::string warning;  ///< empty: none
  std::vector<RunFact> facts;
  RowsByUnit rows;
};

/// Writes the text that read_parts() reads: lines of tab-separated fields, with an end marker in the last line.
void write_part(const ReportPart& part, std::ostream& out);

/// Merges the parts in these files: lists differing facts and warnings side by side; the time is from the earliest
/// start to the latest end, and the processor times are summed. Throws InputError for a file that is not a complete
/// part, for parts of different reports, or if a shard is missing or duplicate.
ReportPart read_parts(const std::vector<std::string>& paths);

}  // namespace spring_workbench::benchmark
