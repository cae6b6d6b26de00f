#pragma once

#include <string>
#include <vector>

#include "benchmark/contact/extremes.h"
#include "benchmark/units.h"

namespace spring_workbench::benchmark {

/// One run of a limit case of contact: a cell of the contact panel of the stability map.
struct ExtremeRow {
  std::string extreme, contact;
  double stiffness = 0.0, step = 0.0;
  int seed = 0;
  ExtremeOutcome outcome;
};
template <typename Fields>
void each_field(ExtremeRow& r, Fields& fields) {
  ExtremeOutcome& o = r.outcome;
  fields(r.extreme, r.contact, r.stiffness, r.step, r.seed, o.finite, o.bounded, o.penetration, o.energy_gained,
         o.refused, o.steps_blocked, o.steps_unsolved);
}

/// Runs every limit case in both contact modes, with forks of 1 … 1e9 N/m and steps of 1/20 … 1/1000 s in turn, on all
/// processors. A mode that was not built has no rows.
std::vector<ExtremeRow> extremes_table(bool quick, Units& units);
/// Number of units of work.
std::size_t extreme_unit_count();

std::string extremes_csv(const std::vector<ExtremeRow>& rows);

}  // namespace spring_workbench::benchmark
