#pragma once

#include <string>
#include <vector>

#include "benchmark/checks.h"
#include "benchmark/report/page.h"

namespace spring_workbench::benchmark {

/// Paths of the CSV files from which pictures are drawn.
struct Tables {
  std::string scenes, rods, elastica, map, limit_cases, contact_map, drags, impacts, motion_steps;
};

/// The sections of the page except the checks, with pictures drawn into `folder`. `elastica_difference`: result of
/// elastica_check().
std::vector<PageSection> page_sections(const Measurements& measured, double elastica_difference, const Tables& tables,
                                       const std::string& folder);

/// The first section: the checks.
PageSection checks_section(const std::vector<Check>& judged);

}  // namespace spring_workbench::benchmark
