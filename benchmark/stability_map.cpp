#include "benchmark/stability_map.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <sstream>
#include <tuple>

#include "benchmark/contact/processor_time.h"
#include "benchmark/energy_watch.h"
#include "benchmark/parallel.h"
#include "benchmark/simulated_rod.h"
#include "spring_workbench/dynamics/integrator.h"
#include "spring_workbench/validation/names.h"

namespace spring_workbench::benchmark {
namespace {

constexpr double kFarthest = 100.0;   // m from the hand,
constexpr double kFlight = 400.0;     // m/s, in addition, for an object without spring that was thrown by half a turn
constexpr double kFall = 0.5 * 9.81;  // m/s², for its fall
constexpr double kTrackerInterval = 0.02;  // s
constexpr double kWatchedSteps = 20.0;
constexpr std::size_t kFailuresKept = 12;  // per integrator and shape

RodCase case_of(const StabilityCell& cell) {
  RodCase one;
  one.name = "stability";
  one.mass = cell.mass;
  one.inertia = cell.mass / 12.0 * Vector3d(0.0125, 0.0425, 0.05);  // a box of 0.2 × 0.1 × 0.05 m
  const double factor = cell.stiffness_factor, zeta = cell.damping_ratio;
  one.fork.stiffness = {2000.0 * factor, 500.0 * factor, 5.0 * factor};
  one.fork.damping_ratio = {zeta, zeta, zeta};
  one.fork.dofs = cell.dofs;
  return one;
}

/// Advances the simulation and evaluates the result.
class CellRun {
 public:
  CellRun(const RodCase& one, const std::string& integrator, const std::string& shape, double step,
          const std::vector<motion::PoseSample>& hand, bool hand_goes_on)
      : simulation_(rod_scene(one), rod_settings(one, shape, integrator, step)),
        energy_(dynamics::make_integrator(validation::named<dynamics::IntegratorKind>(integrator, "map", "integrator"))
                    ->energy()),
        p_HO_(one.fork.length * Vector3d::UnitZ() - one.p_OE),
        hand_goes_on_(hand_goes_on) {
    for (const motion::PoseSample& sample : hand) simulation_.push_stylus(sample);
  }

  /// Returns false if there is no point in continuing.
  bool advance(double t) {
    const simulation::AdvanceReport report = simulation_.advance_to(t);
    outcome_.rejected += report.steps_rejected;
    outcome_.steps += static_cast<int>(report.steps);
    outcome_.stops += report.stops;
    outcome_.fallback += report.steps_fallback;
    outcome_.substeps += static_cast<int>(report.substeps);
    estimated_ = report.energy_error;
    const bodies::BodyState& object = simulation_.objects()[0];
    const Twist& V = object.V_WO_W;
    outcome_.finite = object.X_WO.matrix().allFinite() && V.linear.allFinite() && V.angular.allFinite();
    const double distance = (object.X_WO.translation() - simulation_.tool().X_WH.translation()).norm();
    // A hand that keeps turning throws an object without spring ever faster, so there is no bound.
    outcome_.bounded = outcome_.finite && (hand_goes_on_ || distance < kFarthest + t * (kFlight + kFall * t));
    return outcome_.bounded;
  }

  dynamics::Integrator::Energy energy() const { return energy_; }
  StabilityOutcome& outcome() { return outcome_; }
  /// State after the last advance().
  EnergyLook look() const {
    const tools::ToolState fork = simulation_.tool();
    const bodies::BodyState& object = simulation_.objects()[0];
    const Vector3d p = object.X_WO.translation();
    return {
        simulation_.time(), fork.elastic_energy + fork.kinetic_energy, p, object.V_WO_W.linear, p - fork.X_WH * p_HO_,
        estimated_};
  }

 private:
  simulation::Simulation simulation_;
  dynamics::Integrator::Energy energy_;
  Vector3d p_HO_;  ///< centre of mass in the handle's frame for a rigid fork [m]
  bool hand_goes_on_;
  StabilityOutcome outcome_;
  double estimated_ = 0.0;  ///< error in energy of the last advance() [J]
};

std::string dofs_name(const rod::ForkDofs& dofs) {
  std::string name;
  if (dofs.stretch) name += 's';
  if (dofs.bend) name += 'b';
  if (dofs.torsion) name += 't';
  return name.empty() ? "none" : name;
}

bool is_of(const StabilityRun& one, const StabilityRow& row) {
  const StabilityCell& cell = one.cell;
  return std::tie(one.integrator, one.shape, cell.stiffness_factor, cell.mass, cell.step, cell.damping_ratio) ==
         std::tie(row.integrator, row.shape, row.stiffness_factor, row.mass, row.step, row.damping_ratio);
}

std::vector<double> decades(double low, double high, double factor) {
  std::vector<double> values;
  for (double value = low; value < 1.5 * high; value *= factor) values.push_back(value);
  return values;
}

void add(const StabilityCell& cell, const StabilityOutcome& outcome, StabilityRow& row) {
  if (cell.cannot_fail()) {
    ++row.cannot_fail;
    return;
  }
  ++row.cells;
  row.real_time += outcome.processor < 1.0;
  row.three_times += outcome.processor < 3.0;
  row.steps += outcome.steps;
  row.stops += outcome.stops;
  row.fallback += outcome.fallback;
  row.substeps += outcome.substeps;
  row.turning += cell.tail == MapTail::lissajous;
  row.energy_growth = std::max(row.energy_growth, outcome.energy_growth);
  row.energy_estimated = std::max(row.energy_estimated, outcome.energy_estimated);
  row.finite += outcome.finite;
  row.bounded += outcome.bounded;
  row.energy_kept += outcome.energy_kept();
  row.energy_judged += outcome.energy_judged;
  row.within_rounding += outcome.energy_within_rounding();
  row.none_rejected += outcome.rejected == 0;
  row.held += outcome.held();
  row.on_its_own += outcome.held_on_its_own();
}

void keep_the_worst(std::vector<StabilityRun>& failures) {
  std::stable_sort(failures.begin(), failures.end(),
                   [](const StabilityRun& a, const StabilityRun& b) { return worse(a.outcome, b.outcome); });
  if (failures.size() > kFailuresKept) failures.resize(kFailuresKept);
}

}  // namespace

void add(const StabilityRow& row, StabilityRow& sum) {
  sum.cells += row.cells;
  sum.finite += row.finite;
  sum.bounded += row.bounded;
  sum.energy_judged += row.energy_judged;
  sum.within_rounding += row.within_rounding;
  sum.energy_kept += row.energy_kept;
  sum.none_rejected += row.none_rejected;
  sum.held += row.held;
  sum.cannot_fail += row.cannot_fail;
  sum.real_time += row.real_time;
  sum.three_times += row.three_times;
  sum.on_its_own += row.on_its_own;
  sum.steps += row.steps;
  sum.stops += row.stops;
  sum.fallback += row.fallback;
  sum.substeps += row.substeps;
  sum.turning += row.turning;
  sum.energy_growth = std::max(sum.energy_growth, row.energy_growth);
  sum.energy_estimated = std::max(sum.energy_estimated, row.energy_estimated);
}

StabilityMap map_of(const std::vector<StabilityRun>& cells) {
  StabilityMap map;
  for (const StabilityRun& one : cells) {
    const StabilityCell& cell = one.cell;
    if (map.rows.empty() || !is_of(one, map.rows.back())) {
      map.rows.push_back({one.integrator, one.shape, cell.stiffness_factor, cell.mass, cell.step, cell.damping_ratio});
    }
    add(cell, one.outcome, map.rows.back());
    if (!one.outcome.held()) map.failures.push_back(one);
  }
  keep_the_worst(map.failures);
  return map;
}

namespace {

/// Runs the cells with one stiffness and mass.
StabilityMap map_of_cells(const StabilityPlan& plan, const std::string& integrator, const std::string& shape,
                          double factor, double mass) {
  std::vector<StabilityRun> cells;
  for (const StabilityCell& cell : cells_of(plan, integrator, factor)) {
    if (cell.mass == mass) cells.push_back({integrator, shape, cell, {}});
  }
  parallel_for(cells.size(), [&](std::size_t i) { cells[i].outcome = run_cell(integrator, shape, cells[i].cell); });
  return map_of(cells);
}

}  // namespace

bool worse(const StabilityOutcome& a, const StabilityOutcome& b) {
  const auto badness = [](const StabilityOutcome& o) {
    return std::tuple(!o.finite, !o.bounded, !o.energy_kept(), o.energy_kept() ? 0.0 : o.energy_growth, o.rejected);
  };
  return badness(a) > badness(b);
}

StabilityPlan stability_plan(bool quick) {
  StabilityPlan plan;
  plan.integrators = validation::names<dynamics::IntegratorKind>();
  plan.shapes = {"linear"};
  plan.stiffness_factors = decades(1e-6, 1e12, quick ? 1e6 : 1e2);
  plan.masses = quick ? std::vector<double>{0.0, 1e-6, 1.0, 1e6} : std::vector<double>{0.0, 1e-6, 1e-3, 1.0, 1e3, 1e6};
  plan.steps = quick ? std::vector<double>{0.05, 0.005} : std::vector<double>{0.05, 0.02, 0.005, 0.001};
  plan.damping_ratios = quick ? std::vector<double>{0.0, 1.0} : std::vector<double>{0.0, 0.001, 0.01, 0.05, 1.0, 10.0};
  if (quick) plan.cells = plan.cells_of_others = 120;
  if (quick) plan.seconds = 0.2;
  for (int i = 0; i < 8; ++i) plan.dofs.push_back({(i & 1) != 0, (i & 2) != 0, (i & 4) != 0});
  plan.hands = {MapHand::jump, MapHand::flip, MapHand::dropout};
  plan.tails = {MapTail::rest,       MapTail::nanometre, MapTail::micrometre, MapTail::tenth_of_a_millimetre,
                MapTail::millimetre, MapTail::lissajous};
  return plan;
}

namespace {

std::vector<StabilityCell> drawn_cells(const StabilityPlan& plan, std::size_t count) {
  std::mt19937 random(20);
  std::vector<StabilityCell> drawn(count);
  for (StabilityCell& cell : drawn) {
    cell = cell_of(plan, [&](const auto& values) { return values[random() % values.size()]; });
    cell.seconds = plan.seconds * (random() % plan.long_one == 0 ? 6.0 : 1.0);
  }
  return drawn;
}

}  // namespace

std::vector<StabilityCell> cells_of(const StabilityPlan& plan, const std::string& integrator, double stiffness_factor) {
  const bool is_default = integrator == validation::name_of(dynamics::DynamicsSettings().integrator);
  const bool is_explicit = integrator == "rk4" || integrator == "semi_implicit_euler";
  std::vector<StabilityCell> cells;
  for (StabilityCell& cell : drawn_cells(plan, is_default ? plan.cells : plan.cells_of_others)) {
    if (cell.stiffness_factor != stiffness_factor) continue;
    if (is_explicit) cell.seconds = plan.seconds;
    cells.push_back(cell);
  }
  std::stable_sort(cells.begin(), cells.end(), [](const StabilityCell& a, const StabilityCell& b) {
    return std::tuple(a.mass, a.step, a.damping_ratio) < std::tuple(b.mass, b.step, b.damping_ratio);
  });
  return cells;
}

namespace {

/// Times for evaluation between `begin` and `end` [s], inclusive. For a hand at rest, first every step, then every 20
/// ms, since grown energy stays above the minimum; otherwise every end of a step.
std::vector<double> looks_of(const MapHandMotion& hand, double begin, double end, double step, bool rests) {
  std::vector<double> looks;
  if (rests) {
    for (double t = begin; t < end + 1e-9; t += t - begin < kWatchedSteps * step ? step : kTrackerInterval)
      looks.push_back(t);
    return looks;
  }
  for (std::size_t i = 0; i + 1 < hand.samples.size(); ++i) {
    const double from = hand.samples[i].t, to = hand.samples[i + 1].t;
    if (from < begin) continue;
    const int steps = static_cast<int>(std::ceil((to - from) / step * (1.0 - 1e-9)));
    for (int j = 0; j < steps; ++j) looks.push_back(from + (to - from) * j / steps);
  }
  looks.push_back(end);
  return looks;
}

void follow(const RodCase& one, const MapHandMotion& hand, double step, CellRun& run) {
  using Energy = dynamics::Integrator::Energy;
  double reached = 0.0;
  const auto go_to = [&](double t) {
    const int looks = std::max(1, static_cast<int>(std::ceil((t - reached) / kTrackerInterval)));
    for (int i = 1; i <= looks; ++i) {
      if (!run.advance(reached + (t - reached) * i / looks)) return false;
    }
    reached = t;
    return true;
  };
  motion::PoseTrack track;
  for (const motion::PoseSample& sample : hand.samples) track.push(sample);
  StabilityOutcome& outcome = run.outcome();
  for (const auto& [begin, end, rests] : hand.watched) {
    if (!go_to(begin)) return;
    EnergyWatch watch(one.mass, one.fork.length);
    double last = begin;
    for (const double t : looks_of(hand, begin, end, step, rests)) {
      if (!run.advance(t)) return;
      watch.look(run.look(), track.segment(0.5 * (last + t)));
      last = t;
    }
    reached = end;
    if (one.mass == 0.0 || run.energy() == Energy::not_applicable || !watch.is_certain()) continue;
    outcome.energy_growth = std::max(outcome.energy_growth, watch.growth());
    outcome.energy_whole_growth = std::max(outcome.energy_whole_growth, watch.whole_growth());
    if (run.energy() == Energy::conserved)
      outcome.energy_estimated = std::max(outcome.energy_estimated, watch.estimates());
    outcome.energy_judged = end == hand.samples.back().t;
  }
  if (hand.samples.back().t > reached) go_to(hand.samples.back().t);
}

}  // namespace

StabilityOutcome run_cell(const std::string& integrator, const std::string& shape, const StabilityCell& cell) {
  const RodCase one = case_of(cell);
  const double interval = std::max(cell.step, kTrackerInterval);
  const MapHandMotion hand = map_hand_motion(cell.hand, cell.tail, cell.seconds, interval, cell.step);
  const double begun = processor_time();
  CellRun run(one, integrator, shape, cell.step, hand.samples, cell.tail == MapTail::lissajous);
  follow(one, hand, cell.step, run);
  run.outcome().processor = (processor_time() - begun) / hand.samples.back().t;
  return run.outcome();
}

std::size_t unit_count(const StabilityPlan& plan) {
  return 2 * plan.integrators.size() * plan.shapes.size() * plan.stiffness_factors.size() *
         plan.masses.size();  // rows and failures
}

StabilityMap stability_map(const StabilityPlan& plan, Units& units) {
  units.begin("stability map");
  StabilityMap map;
  std::size_t number = 0;
  for (const std::string& integrator : plan.integrators) {
    for (const std::string& shape : plan.shapes) {
      std::vector<StabilityRun> worst;
      for (const double factor : plan.stiffness_factors) {
        for (const double mass : plan.masses) {
          std::ostringstream name;
          name << integrator << ' ' << shape << " × " << factor << ", " << mass << " kg";
          StabilityMap part;
          part.rows = units.rows<StabilityRow>(number, "stability: " + name.str(), [&] {
            part = map_of_cells(plan, integrator, shape, factor, mass);
            return part.rows;
          });
          part.failures = units.rows<StabilityRun>(number++, "failures: " + name.str(), [&] { return part.failures; });
          map.rows.insert(map.rows.end(), part.rows.begin(), part.rows.end());
          worst.insert(worst.end(), part.failures.begin(), part.failures.end());
        }
        ++number;  // so that each shard gets every mass
      }
      keep_the_worst(worst);
      map.failures.insert(map.failures.end(), worst.begin(), worst.end());
    }
  }
  return map;
}

std::string stability_csv(const StabilityMap& map) {
  std::ostringstream out;
  out << "integrator,shape,stiffness_factor,mass,step,damping_ratio,cells,finite,bounded,energy_judged,energy_kept,"
         "none_rejected,"
         "passed,cannot_fail,real_time,three_times,on_its_own,turning,steps,substeps,stops,steps_fallback,fallback_"
         "share,"
         "energy_growth,energy_estimated,within_rounding\n";
  for (const StabilityRow& row : map.rows) {
    out << row.integrator << ',' << row.shape << ',' << row.stiffness_factor << ',' << row.mass << ',' << row.step
        << ',' << row.damping_ratio << ',' << row.cells << ',' << row.finite << ',' << row.bounded << ','
        << row.energy_judged << ',' << row.energy_kept << ',' << row.none_rejected << ',' << row.held << ','
        << row.cannot_fail << ',' << row.real_time << ',' << row.three_times << ',' << row.on_its_own << ','
        << row.turning << ',' << row.steps << ',' << row.substeps << ',' << row.stops << ',' << row.fallback << ','
        << (row.steps > 0.0 ? row.fallback / row.steps : 0.0) << ',' << row.energy_growth << ',' << row.energy_estimated
        << ',' << row.within_rounding << '\n';
  }
  return out.str();
}

std::string failures_csv(const StabilityMap& map) {
  std::ostringstream out;
  out << "integrator,shape,stiffness_factor,mass,step,damping_ratio,families,hand,tail,seconds,finite,bounded,"
         "energy_judged,energy_growth,energy_whole_growth,energy_estimated,steps_rejected,steps,substeps,stops,steps_"
         "fallback,"
         "processor_time\n";
  for (const StabilityRun& f : map.failures) {
    out << f.integrator << ',' << f.shape << ',' << f.cell.stiffness_factor << ',' << f.cell.mass << ',' << f.cell.step
        << ',' << f.cell.damping_ratio << ',' << dofs_name(f.cell.dofs) << ',' << name_of(f.cell.hand) << ','
        << name_of(f.cell.tail) << ',' << f.cell.seconds << ',' << f.outcome.finite << ',' << f.outcome.bounded << ','
        << f.outcome.energy_judged << ',' << f.outcome.energy_growth << ',' << f.outcome.energy_whole_growth << ','
        << f.outcome.energy_estimated << ',' << f.outcome.rejected << ',' << f.outcome.steps << ','
        << f.outcome.substeps << ',' << f.outcome.stops << ',' << f.outcome.fallback << ',' << f.outcome.processor
        << '\n';
  }
  return out.str();
}

}  // namespace spring_workbench::benchmark
