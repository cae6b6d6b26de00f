#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "benchmark/map_hand.h"
#include "benchmark/rod_case.h"
#include "benchmark/units.h"

namespace spring_workbench::benchmark {

/// What is varied. Every combination is a cell; of short steps, which cost most, some in turn are run.
struct StabilityPlan {
  std::vector<std::string> integrators;
  std::vector<std::string> shapes;
  std::vector<double> stiffness_factors;  ///< over 2000 N/m, 500 N/m, 5 N·m/rad on 0.2 m
  std::vector<double> masses;             ///< [kg]; 0: massless
  std::vector<double> steps;              ///< [s]
  std::vector<std::size_t> in_turn;       ///< by step: how many of families × hands are run with each of the rest
  std::vector<double> damping_ratios;
  std::vector<rod::ForkDofs> families;
  std::vector<MapHand> hands;
};
StabilityPlan stability_plan(bool quick);

/// One run.
struct StabilityCell {
  double stiffness_factor = 1.0;
  double mass = 1.0;
  double step = 0.02;
  double damping_ratio = 1.0;
  rod::ForkDofs families;
  MapHand hand = MapHand::lissajous;
};

/// What came of it.
struct StabilityOutcome {
  bool finite = true;          ///< pose and twist of the object
  bool bounded = true;         ///< within 100 m of the hand; a free fall is 20 m
  double energy_growth = 0.0;  ///< largest growth while the hand rests beyond the steps' own estimates of their
                               ///< errors, over the largest energy then (see the .cpp)
  int refused = 0;             ///< steps not taken, or of an explicit method stopped or done by the L-stable rule
  bool energy_kept() const { return energy_growth <= 1e-9; }
  bool held() const { return finite && bounded && energy_kept() && refused == 0; }
};

/// Whether `a` is the worse: first by what is finite, then bounded, then by energy gained, then by steps refused.
bool worse(const StabilityOutcome& a, const StabilityOutcome& b);

/// Runs a cell through Simulation, as a user would: samples in, poses out; the hand is sampled at 50 Hz, or at the step
/// where that is longer, since a step ends at every sample.
StabilityOutcome run_cell(const std::string& integrator, const std::string& shape, const StabilityCell& cell);

/// Counts over families and hands.
struct StabilityRow {
  std::string integrator, shape;
  double stiffness_factor = 0.0, mass = 0.0, step = 0.0, damping_ratio = 0.0;
  int cells = 0, finite = 0, bounded = 0, energy_kept = 0, none_refused = 0, held = 0;
};

template <typename Fields>
void each_field(StabilityRow& r, Fields& fields) {
  fields(r.integrator, r.shape, r.stiffness_factor, r.mass, r.step, r.damping_ratio, r.cells, r.finite, r.bounded,
         r.energy_kept, r.none_refused, r.held);
}

/// A cell that did not hold.
struct StabilityFailure {
  std::string integrator, shape;
  StabilityCell cell;
  StabilityOutcome outcome;
};
template <typename Fields>
void each_field(StabilityFailure& f, Fields& fields) {
  StabilityCell& c = f.cell;
  StabilityOutcome& o = f.outcome;
  fields(f.integrator, f.shape, c.stiffness_factor, c.mass, c.step, c.damping_ratio, c.families.stretch,
         c.families.bend, c.families.torsion, c.hand, o.finite, o.bounded, o.energy_growth, o.refused);
}

struct StabilityMap {
  std::vector<StabilityRow> rows;
  std::vector<StabilityFailure> failures;  ///< the worst few of each integrator and shape, worst first
};

/// The cells of one stiffness. Of a step with fewer in turn than there are pairs of families and hands, each pair has
/// its turn with some of the masses and damping ratios.
std::vector<StabilityCell> cells_of(const StabilityPlan& plan, double stiffness_factor);

/// Number of units of progress, and the map; runs cells on all processors at once.
std::size_t unit_count(const StabilityPlan& plan);
StabilityMap stability_map(const StabilityPlan& plan, Units& units);

std::string stability_csv(const StabilityMap& map);
std::string failures_csv(const StabilityMap& map);

}  // namespace spring_workbench::benchmark
