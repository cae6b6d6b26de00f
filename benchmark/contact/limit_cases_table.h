#pragma once

#include <string>
#include <vector>

#include "benchmark/contact/limit_cases.h"
#include "benchmark/units.h"

namespace spring_workbench::benchmark {

/// One run of a limit case of contact: a cell of the contact panel of the stability map.
struct LimitCaseRow {
  std::string limit_case, contact;
  double stiffness = 0.0, step = 0.0;
  int seed = 0;
  LimitCaseOutcome outcome;
};
template <typename Fields>
void each_field(LimitCaseRow& r, Fields& fields) {
  LimitCaseOutcome& o = r.outcome;
  fields(r.limit_case, r.contact, r.stiffness, r.step, r.seed, o.finite, o.bounded, o.penetration, o.energy_gained,
         o.rejected, o.steps_blocked, o.steps_unsolved);
}

/// Runs every limit case in both contact modes, with forks of 1 … 1e9 N/m and steps of 1/20 … 1/1000 s in turn, on all
/// processors. A mode that was not built has no rows.
std::vector<LimitCaseRow> limit_cases_table(bool quick, Units& units);
/// Number of units of work.
std::size_t limit_case_unit_count();

std::string limit_cases_csv(const std::vector<LimitCaseRow>& rows);

}  // namespace spring_workbench::benchmark
