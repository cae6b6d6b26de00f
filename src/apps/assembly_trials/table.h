#pragma once

#include <string>
#include <vector>

#include "spring_workbench/assembly/task_score.h"

namespace spring_workbench::assembly_trials {

/// The trials of one tool.
struct ToolTrials {
  std::string label;
  std::vector<assembly::TaskScore> scores;
};

/// A table in CSV, a line per tool: means with the half width of their 95 % confidence interval (Student's t), and
/// the share of completed trials with Wilson's interval.
std::string means_csv(const std::vector<ToolTrials>& tools);

}  // namespace spring_workbench::assembly_trials
