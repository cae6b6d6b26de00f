#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "benchmark/energy_watch.h"
#include "benchmark/map_hand.h"
#include "benchmark/rod_case.h"
#include "benchmark/units.h"

namespace spring_workbench::benchmark {

/// What is varied. The cells are drawn from all combinations, seeded, so many that every pair of values is met.
struct StabilityPlan {
  std::vector<std::string> integrators;
  std::vector<std::string> shapes;
  std::vector<double> stiffness_factors;  ///< over 2000 N/m, 500 N/m, 5 N·m/rad on 0.2 m
  std::vector<double> masses;             ///< [kg]; 0: massless
  std::vector<double> steps;              ///< [s]
  std::vector<double> damping_ratios;
  std::vector<rod::ForkDofs> families;
  std::vector<MapHand> hands;
  std::vector<MapTail> tails;
  std::size_t cells = 4000;           ///< of the default integrator and a shape
  std::size_t cells_of_others = 500;  ///< of each other one: the first of these
  double seconds = 10.0;              ///< of the hand's tail
  std::size_t long_one = 200;         ///< one in so many has six times that
};
StabilityPlan stability_plan(bool quick);

/// One run.
struct StabilityCell {
  double stiffness_factor = 1.0;
  double mass = 1.0;
  double step = 0.02;
  double damping_ratio = 1.0;
  rod::ForkDofs families;
  MapHand hand = MapHand::jump;
  MapTail tail = MapTail::rest;
  double seconds = 0.1;
  /// Without mass or with every DOF rigid nothing is integrated.
  bool cannot_fail() const { return mass == 0.0 || !(families.stretch || families.bend || families.torsion); }
};

/// What came of it.
struct StabilityOutcome {
  bool finite = true;             ///< pose and twist of the object
  bool bounded = true;            ///< no further from the hand than free flight may be (see the .cpp)
  double energy_growth = 0.0;     ///< largest growth while the hand does not turn (EnergyWatch::growth)
  double energy_estimated = 0.0;  ///< what the steps of an integrator that keeps its energy say of their errors then
  bool energy_judged = false;     ///< to the end, and the hand's work was known well enough
  int refused = 0;                ///< steps not taken, or of an explicit method stopped or done by the L-stable rule
  int steps = 0, stops = 0, fallback = 0;  ///< of the integrator; that met a stop; done by the L-stable rule
  double processor = 0.0;                  ///< time over simulated time
  bool energy_kept() const { return energy_growth <= 1e-9 && energy_estimated <= EnergyWatch::most_share; }
  bool held() const { return finite && bounded && energy_kept() && refused == 0; }
};

/// Whether `a` is the worse: first by what is finite, then bounded, then by energy gained, then by steps refused.
bool worse(const StabilityOutcome& a, const StabilityOutcome& b);

/// Runs a cell through Simulation, as a user would: samples in, poses out; the hand is sampled at 50 Hz, or at the step
/// where that is longer, since a step ends at every sample.
StabilityOutcome run_cell(const std::string& integrator, const std::string& shape, const StabilityCell& cell);

/// Counts over families and hands, of the cells that can fail.
struct StabilityRow {
  std::string integrator, shape;
  double stiffness_factor = 0.0, mass = 0.0, step = 0.0, damping_ratio = 0.0;
  int cannot_fail = 0;  ///< cells that were drawn beside
  int cells = 0, finite = 0, bounded = 0, energy_judged = 0, energy_kept = 0, none_refused = 0, held = 0;
  int real_time = 0, three_times = 0;  ///< processor time below the simulated time; below three times that
  int on_its_own = 0;                  ///< cells that hold without a stop and without the fallback
  double steps = 0.0, stops = 0.0, fallback = 0.0;
};

template <typename Fields>
void each_field(StabilityRow& r, Fields& fields) {
  fields(r.integrator, r.shape, r.stiffness_factor, r.mass, r.step, r.damping_ratio, r.cells, r.finite, r.bounded,
         r.energy_judged, r.energy_kept, r.none_refused, r.held, r.cannot_fail, r.real_time, r.three_times, r.steps,
         r.stops, r.fallback, r.on_its_own);
}

/// The sum of the rows of one integrator, or of one and its shape.
void add(const StabilityRow& row, StabilityRow& sum);

/// A cell and what came of it.
struct StabilityRun {
  std::string integrator, shape;
  StabilityCell cell;
  StabilityOutcome outcome;
};
template <typename Fields>
void each_field(StabilityRun& f, Fields& fields) {
  StabilityCell& c = f.cell;
  StabilityOutcome& o = f.outcome;
  fields(f.integrator, f.shape, c.stiffness_factor, c.mass, c.step, c.damping_ratio, c.families.stretch,
         c.families.bend, c.families.torsion, c.hand, c.tail, c.seconds, o.finite, o.bounded, o.energy_growth,
         o.energy_estimated, o.energy_judged, o.refused, o.steps, o.stops, o.fallback, o.processor);
}

struct StabilityMap {
  std::vector<StabilityRow> rows;
  std::vector<StabilityRun> failures;  ///< the worst few of each integrator and shape, worst first
};

/// The rows of cells that have been run, those of a row one after the other.
StabilityMap map_of(const std::vector<StabilityRun>& cells);

/// Those of an integrator's cells that have this stiffness, in the order of mass, step and damping ratio.
std::vector<StabilityCell> cells_of(const StabilityPlan& plan, const std::string& integrator, double stiffness_factor);

/// Number of units of progress, and the map; runs cells on all processors at once.
std::size_t unit_count(const StabilityPlan& plan);
StabilityMap stability_map(const StabilityPlan& plan, Units& units);

std::string stability_csv(const StabilityMap& map);
std::string failures_csv(const StabilityMap& map);

}  // namespace spring_workbench::benchmark
