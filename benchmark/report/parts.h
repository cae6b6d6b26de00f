#pragma once

#include <ostream>
#include <string>
#include <vector>

#include "benchmark/report/run_facts.h"
#include "benchmark/units.h"

namespace spring_workbench::benchmark {

/// How long a report or a shard of it takes.
struct RunTime {
  double begun = 0.0, ended = 0.0;  ///< by the machine's clock [s]
  double processor = 0.0;           ///< of all its processes [s]
};

/// The present, and what this process and its children have used so far; `begun` is left 0.
RunTime run_time_now();

/// What one shard of a report has measured, or all of them have.
struct ReportPart {
  Shard shard;
  bool quick = false;
  RunTime time;
  std::string warning;  ///< empty: none
  std::vector<RunFact> facts;
  RowsByUnit rows;
};

/// As text that read_parts() reads: lines, with tabs between what stands in them; its last line says that it is all.
void write_part(const ReportPart& part, std::ostream& out);

/// The parts in these files together: facts and warnings that differ stand beside each other, the time is from the
/// first one's begin to the last one's end, and the sum of their processor times. Throws InputError for a file that is
/// not a part or not a whole one, parts of different reports, and where a shard is missing or there twice.
ReportPart read_parts(const std::vector<std::string>& paths);

}  // namespace spring_workbench::benchmark
