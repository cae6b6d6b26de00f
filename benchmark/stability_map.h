#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "benchmark/energy_watch.h"
#include "benchmark/map_hand.h"
#include "benchmark/rod_case.h"
#include "benchmark/units.h"

namespace spring_workbench::benchmark {

/// The varied parameters. Cells are random combinations (seeded), enough to contain every pair of values. Another
/// integrator than the default one has the first `cells_of_others` of them.
struct StabilityPlan {
  std::vector<std::string> integrators;
  std::vector<std::string> shapes;
  std::vector<double> stiffness_factors;  ///< relative to 2000 N/m, 500 N/m, 5 N·m/rad on 0.2 m
  std::vector<double> masses;             ///< [kg]; 0: massless
  std::vector<double> steps;              ///< [s]
  std::vector<double> damping_ratios;
  std::vector<rod::ForkDofs> dofs;
  std::vector<MapHand> hands;
  std::vector<MapTail> tails;
  std::size_t cells = 4000;           ///< number for the default integrator and each shape
  std::size_t cells_of_others = 500;  ///< number of them for each other integrator
  double seconds = 10.0;              ///< duration of the hand's tail [s]
  std::size_t long_one = 200;         ///< one cell in this many has six times that duration
};
StabilityPlan stability_plan(bool quick);

/// One run.
struct StabilityCell {
  double stiffness_factor = 1.0;
  double mass = 1.0;
  double step = 0.02;
  double damping_ratio = 1.0;
  rod::ForkDofs dofs;
  MapHand hand = MapHand::jump;
  MapTail tail = MapTail::rest;
  double seconds = 0.1;
  /// Whether nothing is integrated: no mass, or all DOFs rigid.
  bool cannot_fail() const { return mass == 0.0 || !(dofs.stretch || dofs.bend || dofs.torsion); }
};

/// Result of a run.
struct StabilityOutcome {
  bool finite = true;                ///< whether pose and twist of the object were finite
  bool bounded = true;               ///< whether the object stayed within the bound of free flight (see the .cpp)
  double energy_growth = 0.0;        ///< largest growth while the hand does not turn (EnergyWatch::growth)
  double energy_whole_growth = 0.0;  ///< EnergyWatch::whole_growth()
  double energy_estimated =
      0.0;  ///< estimated energy errors of the steps in these times, for integrators that conserve energy
  bool energy_judged =
      false;         ///< whether the energy could be judged: run completed, and the work of the hand known well enough
  int rejected = 0;  ///< steps rejected
  int steps = 0, stops = 0, fallback = 0;  ///< steps of the integrator; that reached a stop; taken by the L-stable rule
  int substeps = 0;                        ///< steps discarded and repeated as shorter ones
  double processor = 0.0;                  ///< ratio of processor time to simulated time
  bool energy_within_rounding() const { return energy_judged && energy_whole_growth <= 1e-9; }
  bool energy_kept() const { return energy_growth <= 1e-9 && energy_estimated <= EnergyWatch::max_share; }
  bool held() const { return finite && bounded && energy_kept() && rejected == 0; }
  /// Whether it held in steps of the length set, without the L-stable rule and without the end of the rod's range: by
  /// the integrator alone.
  bool held_on_its_own() const { return held() && stops + fallback + substeps == 0; }
};

/// Whether `a` is worse than `b`: compares finite, then bounded, then energy growth, then rejected steps.
bool worse(const StabilityOutcome& a, const StabilityOutcome& b);

/// Runs a cell through Simulation as used by applications: samples in, poses out. The hand is sampled at 50 Hz, or once
/// per step if that is longer, since a step ends at every sample.
StabilityOutcome run_cell(const std::string& integrator, const std::string& shape, const StabilityCell& cell);

/// Counts over DOFs and hands, for the cells that can fail.
struct StabilityRow {
  std::string integrator, shape;
  double stiffness_factor = 0.0, mass = 0.0, step = 0.0, damping_ratio = 0.0;
  int cannot_fail = 0;  ///< additional cells that cannot fail
  int cells = 0, finite = 0, bounded = 0, energy_judged = 0, energy_kept = 0, none_rejected = 0, held = 0;
  int real_time = 0, three_times = 0;  ///< cells with processor time below one and below three times the simulated time
  int on_its_own = 0;                  ///< cells of StabilityOutcome::held_on_its_own()
  int turning = 0;  ///< cells whose hand turns to the end: neither the object's reach nor its energy is judged
  double steps = 0.0, stops = 0.0, fallback = 0.0, substeps = 0.0;
  double energy_growth = 0.0, energy_estimated = 0.0;  ///< the largest of the outcomes
  int within_rounding = 0;  ///< cells of energy_judged whose energy grows by less than 1e-9, estimates not allowed for
};

template <typename Fields>
void each_field(StabilityRow& r, Fields& fields) {
  fields(r.integrator, r.shape, r.stiffness_factor, r.mass, r.step, r.damping_ratio, r.cells, r.finite, r.bounded,
         r.energy_judged, r.energy_kept, r.none_rejected, r.held, r.cannot_fail, r.real_time, r.three_times, r.steps,
         r.stops, r.fallback, r.on_its_own, r.turning, r.substeps, r.energy_growth, r.energy_estimated,
         r.within_rounding);
}

/// The sum of the rows of one integrator, or of one and its shape.
void add(const StabilityRow& row, StabilityRow& sum);

/// A cell and its result.
struct StabilityRun {
  std::string integrator, shape;
  StabilityCell cell;
  StabilityOutcome outcome;
};
template <typename Fields>
void each_field(StabilityRun& f, Fields& fields) {
  StabilityCell& c = f.cell;
  StabilityOutcome& o = f.outcome;
  fields(f.integrator, f.shape, c.stiffness_factor, c.mass, c.step, c.damping_ratio, c.dofs.stretch, c.dofs.bend,
         c.dofs.torsion, c.hand, c.tail, c.seconds, o.finite, o.bounded, o.energy_growth, o.energy_whole_growth,
         o.energy_estimated, o.energy_judged, o.rejected, o.steps, o.stops, o.fallback, o.substeps, o.processor);
}

struct StabilityMap {
  std::vector<StabilityRow> rows;
  std::vector<StabilityRun> failures;  ///< the worst few of each integrator and shape, worst first
};

/// A cell of the plan's values, `one_of(values)` in this order; its duration is not set.
template <typename OneOf>
StabilityCell cell_of(const StabilityPlan& plan, OneOf&& one_of) {
  StabilityCell cell;
  cell.stiffness_factor = one_of(plan.stiffness_factors);
  cell.mass = one_of(plan.masses);
  cell.step = one_of(plan.steps);
  cell.damping_ratio = one_of(plan.damping_ratios);
  cell.dofs = one_of(plan.dofs);
  cell.hand = one_of(plan.hands);
  cell.tail = one_of(plan.tails);
  return cell;
}

/// Counts the rows of the cells that have been run; cells of one row must be consecutive.
StabilityMap map_of(const std::vector<StabilityRun>& cells);

/// The cells of an integrator with this stiffness, ordered by mass, step and damping ratio. The explicit integrators,
/// which are there for comparison, have no longer ones.
std::vector<StabilityCell> cells_of(const StabilityPlan& plan, const std::string& integrator, double stiffness_factor);

/// Number of units of progress, and the map; runs cells on all processors at once.
std::size_t unit_count(const StabilityPlan& plan);
StabilityMap stability_map(const StabilityPlan& plan, Units& units);

std::string stability_csv(const StabilityMap& map);
std::string failures_csv(const StabilityMap& map);

}  // namespace spring_workbench::benchmark
