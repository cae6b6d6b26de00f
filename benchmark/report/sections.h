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

/// The page's sections, with pictures drawn into `folder`. `elastica_difference`: as elastica_check().
std::vector<PageSection> page_sections(const Measurements& measured, const std::vector<Verdict>& judged,
                                       double elastica_difference, const Tables& tables, const std::string& folder);

}  // namespace spring_workbench::benchmark
