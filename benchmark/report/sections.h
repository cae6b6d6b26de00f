#pragma once

#include <string>
#include <vector>

#include "benchmark/report/page.h"
#include "benchmark/verdicts.h"

namespace spring_workbench::benchmark {

/// Paths of the CSV files that pictures are drawn from.
struct Tables {
  std::string scenes, rods, elastica, map, extremes, drags, impacts, world_steps;
};

/// The page's sections but that of the verdicts, with pictures drawn into `folder`. `elastica_difference`: as
/// elastica_check().
std::vector<PageSection> page_sections(const Measurements& measured, double elastica_difference, const Tables& tables,
                                       const std::string& folder);

/// The first of them all.
PageSection verdicts_section(const std::vector<Verdict>& judged);

}  // namespace spring_workbench::benchmark
