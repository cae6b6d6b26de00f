#include "benchmark/verdicts.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>
#include <sstream>

#include "benchmark/curve.h"
#include "benchmark/our_methods.h"
#include "spring_workbench/dynamics/integrator.h"
#include "spring_workbench/validation/names.h"

namespace spring_workbench::benchmark {
namespace {

constexpr double kError = 1e-6;  // of the hand's amplitude: what run times are compared at
constexpr double kEvery50Hz = 0.02;
constexpr const char* kOurs = "exponential";

/// Baselines that are known to have a stability limit; every other integrator is to have none.
const std::set<std::string> kExplicit = {"semi_implicit_euler", "rk4"};

std::string text(double value, int digits = 3) {
  std::ostringstream out;
  out.precision(digits);
  out << value;
  return out.str();
}

Verdict judged(std::string claim, std::string target, std::string measured, bool held) {
  return {std::move(claim), std::move(target), std::move(measured),
          held ? Verdict::Result::pass : Verdict::Result::fail};
}

bool is_ours(const std::string& method) {
  const std::vector<std::string>& names = validation::names<dynamics::IntegratorKind>();
  return std::find(names.begin(), names.end(), method) != names.end();
}
/// What its limit is measured against is not the equation of motion: out of every comparison.
bool has_own_law(const std::string& method) { return is_ours(method) && !solves_the_equation_of_motion(method); }
bool is_cvode(const std::string& method) { return method.rfind("cvode", 0) == 0; }
bool is_engine(const std::string& method) {
  return !is_ours(method) && !is_cvode(method) && method.rfind("hand_", 0) != 0;
}

/// The method among those `wanted` that needs the least run time at kError in a scene.
struct Best {
  std::string method;
  double run_time = std::numeric_limits<double>::infinity();
  bool found() const { return !method.empty(); }
};

Best best_of(const std::vector<ErrorRow>& rows, const std::string& scene, double factor,
             const std::function<bool(const std::string&)>& wanted) {
  std::set<std::string> methods;
  for (const ErrorRow& row : rows) {
    if (row.scene == scene && row.stiffness_factor == factor && row.hand == "function" && wanted(row.method) &&
        !has_own_law(row.method)) {
      methods.insert(row.method);
    }
  }
  Best best;
  for (const std::string& method : methods) {
    const auto time = run_time_for_error(curve(rows,
                                               [&](const ErrorRow& row) {
                                                 return row.scene == scene && row.stiffness_factor == factor &&
                                                        row.hand == "function" && row.method == method;
                                               }),
                                         kError);
    if (time && *time < best.run_time) best = {method, *time};
  }
  return best;
}

std::set<double> factors_of(const std::vector<ErrorRow>& rows, const std::string& scene) {
  std::set<double> factors;
  for (const ErrorRow& row : rows) {
    if (row.scene == scene) factors.insert(row.stiffness_factor);
  }
  return factors;
}

std::string time_of(const Best& best) {
  return best.found() ? best.method + ' ' + text(best.run_time) + " µs/s" : "no one reaches it";
}

void one_step_per_sample(const Measurements& m, const std::string& scene, std::vector<Verdict>& out) {
  for (const char* hand : {"function", "samples"}) {
    double largest = 0.0;
    bool any = false, finite = true;
    for (const ErrorRow& row : m.scenes) {
      if (row.scene != scene || row.method != kOurs || row.hand != hand || std::abs(row.step - kEvery50Hz) > 1e-9)
        continue;
      any = true;
      finite = finite && row.finite;
      largest = std::max(largest, row.error);
    }
    if (!any) continue;
    const std::string unit = scene == "A" ? " m" : " rad";
    const bool given = std::string(hand) == "function";
    const std::string claim =
        "Scene " + scene + ", " + kOurs + ", one step per 50 Hz sample, every stiffness; the hand's " +
        (given ? "pose, velocity and acceleration known at the samples" : "poses alone known at the samples");
    if (given) {
      out.push_back(judged(claim, "error ≤ 1e-6" + unit, text(largest) + unit, finite && largest <= 1e-6));
    } else {
      out.push_back({claim, "none: the motion between the samples is not known", text(largest) + unit,
                     Verdict::Result::not_measured});
    }
  }
}

void beats_every_peer(const Measurements& m, const std::string& scene, std::vector<Verdict>& out) {
  for (const double factor : factors_of(m.scenes, scene)) {
    const Best ours = best_of(m.scenes, scene, factor, [](const std::string& s) { return is_ours(s); });
    const Best peer = best_of(m.scenes, scene, factor, [](const std::string& s) { return !is_ours(s); });
    out.push_back(
        judged("Scene " + scene + " × " + text(factor) + " at 1e-6 of the amplitude: run time against every peer",
               "less", "ours " + time_of(ours) + "; best peer " + time_of(peer), ours.run_time < peer.run_time));
  }
}

void faster_by(const Measurements& m, double factor, double target, const std::string& whom,
               const std::function<bool(const std::string&)>& wanted, std::vector<Verdict>& out) {
  const Best ours = best_of(m.scenes, "C", factor, [](const std::string& s) { return is_ours(s); });
  const Best other = best_of(m.scenes, "C", factor, wanted);
  const double ratio = other.run_time / ours.run_time;
  const std::string figure = "ours " + time_of(ours) + "; " + time_of(other) +
                             (other.found() && ours.found() ? " = " + text(ratio) + "×" : "");
  out.push_back(judged("Scene C × " + text(factor) + " at 1e-6 of the amplitude: " + whom + " over ours",
                       "≥ " + text(target) + "×", figure, ours.found() && !(ratio < target)));
}

void scene_c(const Measurements& m, std::vector<Verdict>& out) {
  for (const double factor : factors_of(m.scenes, "C")) {
    const bool stiff = factor >= 100.0;
    faster_by(m, factor, stiff ? 50.0 : 20.0, "best engine", is_engine, out);
    for (const char* formulation : {"cvode_world", "cvode_deflection"}) {
      faster_by(
          m, factor, stiff ? 20.0 : 2.0, formulation, [&](const std::string& s) { return s == formulation; }, out);
    }
  }
}

/// A step of MuJoCo's RK4 in scene C [µs]: by it, machines are compared. Infinite where it was not measured.
double mujoco_step(const Measurements& m) {
  double least = std::numeric_limits<double>::infinity();
  for (const ErrorRow& row : m.scenes) {
    if (row.scene == "C" && row.method == "mujoco_rk4" && row.finite) {
      least = std::min(least, row.wall_us_per_simulated_second / row.steps_per_second);
    }
  }
  return least;
}

/// The feasibility sketch's times, from another machine, by what MuJoCo's step took there and takes here.
void sketch(const Measurements& m, std::vector<Verdict>& out) {
  constexpr double there = 3.164;  // [µs]
  const double here = mujoco_step(m), slower = std::isfinite(here) ? here / there : 1.0;
  for (const auto& [factor, run_time] : {std::pair{1.0, 425.0}, std::pair{100.0, 42.0}}) {
    if (factors_of(m.scenes, "C").count(factor) == 0) continue;
    const Best ours = best_of(m.scenes, "C", factor, [](const std::string& s) { return is_ours(s); });
    out.push_back(
        judged("Scene C × " + text(factor) + " at 1e-6: the feasibility sketch, scaled by MuJoCo's step here and there",
               "< " + text(run_time) + " × " + text(slower) + " = " + text(run_time * slower) + " µs/s", time_of(ours),
               ours.run_time < run_time * slower));
  }
}

void rods(const Measurements& m, std::vector<Verdict>& out) {
  for (const ErrorRow& row : m.rods) {
    if (row.method != kOurs || row.shape != "linear" || std::abs(row.step - kEvery50Hz) > 1e-9) continue;
    const std::string name = row.scene.substr(row.scene.rfind("recorded_", 0) == 0 ? 9 : 0);
    const bool heavy = name == "heavy_large_bend";
    if (!heavy && name != "soft_6dof" && name != "underdamped" && name != "stiff_6dof") continue;
    const std::string figure = text(row.error) + " m, " + text(row.angle_error) + " rad";
    out.push_back(judged("Rod " + row.scene + ", " + kOurs + ", step 0.02 s, ending at samples",
                         heavy ? "within 1e-4 m" : "within 1e-5 m and 1e-4 rad", row.finite ? figure : "not finite",
                         row.finite && (heavy ? row.error <= 1e-4 : row.error <= 1e-5 && row.angle_error <= 1e-4)));
  }
}

void cost_of_a_step(const Measurements& m, std::vector<Verdict>& out) {
  double ours = 0.0;
  for (const ErrorRow& row : m.rods) {
    if (row.scene == "soft_6dof" && row.shape == "linear" && row.method == kOurs && row.finite &&
        std::abs(row.step - kEvery50Hz) < 1e-9) {
      ours = row.wall_us_per_simulated_second / row.steps_per_second;
    }
  }
  const double peer = mujoco_step(m);
  const std::string claim = "One full step of the rod (soft_6dof, linear, exponential, one per sample, with its hand)";
  const std::string target = "≤ 2 MuJoCo RK4 steps of scene C";
  if (ours > 0.0 && std::isfinite(peer)) {
    out.push_back(judged(claim, target, text(ours) + " µs; MuJoCo " + text(peer) + " µs", ours <= 2.0 * peer));
  } else {
    out.push_back({claim, target, "not measured", Verdict::Result::not_measured});
  }
}

void tolerance(const Measurements& m, std::vector<Verdict>& out) {
  std::set<std::string> methods;
  for (const ErrorRow& row : m.rods) {
    if (row.tolerance > 0.0) methods.insert(row.method);
  }
  for (const std::string& method : methods) {
    double least = std::numeric_limits<double>::infinity(), largest = 0.0;
    int within = 0, not_above = 0, count = 0, given_up = 0;
    for (const ErrorRow& row : m.rods) {
      // Where one step per sample is better than asked there is nothing to choose.
      if (row.tolerance <= 0.0 || row.method != method) continue;
      if (row.given_up) {
        ++given_up;
        continue;
      }
      ++count;
      if (!row.finite) continue;
      least = std::min(least, row.error_over_tolerance);
      largest = std::max(largest, row.error_over_tolerance);
      not_above += row.error_over_tolerance <= 3.0;
      within += row.error_over_tolerance <= 3.0 && row.error_over_tolerance >= 1.0 / 3.0;
    }
    if (count == 0) continue;
    const std::string figure = text(least) + " … " + text(largest) + " of it; " + std::to_string(within) + " of " +
                               std::to_string(count) + " within a factor of 3 both ways, " + std::to_string(not_above) +
                               " no more than 3 above; " + std::to_string(given_up) + " took too long";
    const std::string what = has_own_law(method) ? ", all rods, of its own limit" : ", all rods";
    out.push_back(judged("Tolerance mode, " + method + what, "error within a factor of 3 of what was asked", figure,
                         not_above == count));
  }
  if (methods.empty()) {
    out.push_back({"Tolerance mode", "error within a factor of 3 of what was asked", "this build has no such mode",
                   Verdict::Result::not_measured});
  }
}

/// How far an integrator's own limit is from the exact motion.
void model_errors(const Measurements& m, std::vector<Verdict>& out) {
  std::map<std::string, std::vector<const ErrorRow*>> rows_of;
  for (const ErrorRow& row : m.rods) {
    if (has_own_law(row.method) && row.finite) rows_of[row.method].push_back(&row);
  }
  for (const auto& [method, rows] : rows_of) {
    const auto less = [](const ErrorRow* a, const ErrorRow* b) { return a->model_error < b->model_error; };
    const auto [least, most] = std::minmax_element(rows.begin(), rows.end(), less);
    out.push_back(
        {"Model error of " + method + ", all rods: how far its limit for short steps is from the exact motion",
         "none: what the scheme leaves out",
         text((*least)->model_error) + " m (" + (*least)->scene + ") … " + text((*most)->model_error) + " m (" +
             (*most)->scene + ')',
         Verdict::Result::not_measured});
  }
}

void stability(const Measurements& m, std::vector<Verdict>& out) {
  for (const std::string& name : validation::names<dynamics::IntegratorKind>()) {
    StabilityRow sum;
    for (const StabilityRow& row : m.map.rows) {
      if (row.integrator != name) continue;
      sum.cells += row.cells;
      sum.finite += row.finite;
      sum.bounded += row.bounded;
      sum.energy_kept += row.energy_kept;
      sum.none_refused += row.none_refused;
      sum.stops += row.stops;
      sum.fallback += row.fallback;
      sum.steps += row.steps;
    }
    if (sum.cells == 0) continue;
    const std::string figure = "of " + std::to_string(sum.cells) + " cells finite " + std::to_string(sum.finite) +
                               ", bounded " + std::to_string(sum.bounded) + ", energy kept " +
                               std::to_string(sum.energy_kept) + "; a step was refused in " +
                               std::to_string(sum.cells - sum.none_refused) + " cells; of " + text(sum.steps) +
                               " steps " + text(sum.fallback) + " by the fallback, " + text(sum.stops) + " at a stop";
    const std::string claim = "Stability map, " + name;
    if (kExplicit.count(name) != 0) {
      out.push_back({claim + " (a baseline with a stability limit)", "none", figure, Verdict::Result::not_measured});
    } else if (has_own_law(name)) {  // whose energy is that of its oscillators
      out.push_back(judged(claim, "every cell finite and bounded, no step refused", figure,
                           sum.finite == sum.cells && sum.bounded == sum.cells && sum.none_refused == sum.cells));
    } else {
      out.push_back(judged(claim, "every cell finite, bounded, no step refused, no energy gained with the hand at rest",
                           figure,
                           sum.finite == sum.cells && sum.bounded == sum.cells && sum.energy_kept == sum.cells &&
                               sum.none_refused == sum.cells));
    }
  }
}

void shapes(const Measurements& m, std::vector<Verdict>& out) {
  constexpr double target = 1.2e-3;  // the table of the model, with its rounding
  for (const ElasticaRow& row : m.elastica) {
    if (row.shape != "linear" || row.alpha != 2.0) continue;
    out.push_back(judged("Shape linear against the exact elastica at P L²/EI = 2", "tip within " + text(target) + " L",
                         text(row.tip_error) + " L", row.tip_error <= target));
  }
}

void contact(const Measurements& m, std::vector<Verdict>& out) {
  for (const char* mode : {"stop", "dynamic"}) {
    double lag = 0.0, depth = 0.0;
    bool any = false, finite = true;
    for (const DragRow& row : m.contact.drags) {
      if (row.method != mode) continue;
      any = true;
      finite = finite && row.finite;
      lag = std::max(lag, row.lag_error);
      depth = std::max(depth, row.penetration);
    }
    if (!any) continue;
    out.push_back(judged(std::string("Drag, contact ") + mode + ", steps of 20 to 1 ms, every stiffness",
                         "lag within 0.1 %, penetration ≤ 0.01 mm",
                         finite ? text(100.0 * lag) + " %, " + text(1e3 * depth) + " mm" : "not finite",
                         finite && lag <= 1e-3 && depth <= 1e-5));
  }
  for (const int levels : {8, 0}) {
    double largest = 0.0;
    int through = 0;
    for (const ImpactRow& row : m.contact.impacts) {
      if (row.levels != levels) continue;
      largest = std::max(largest, row.largest_error);
      through += row.through;
    }
    if (m.contact.impacts.empty()) continue;
    const std::string name = levels == 0 ? "time of impact" : std::to_string(levels) + " levels of bisection";
    out.push_back(judged("Pose of first contact, " + name + ", ways of 40 mm", "within 0.01 mm, no way through",
                         text(1e3 * largest) + " mm, " + std::to_string(through) + " through",
                         largest <= 1e-5 && through == 0));
  }
  std::set<std::string> scenes;
  for (const WorldStepRow& row : m.contact.world_steps) scenes.insert(row.scene);
  for (const std::string& scene : scenes) {
    for (const WorldStepRow& row : m.contact.world_steps) {
      if (row.scene != scene || std::abs(row.step - 2e-3) > 1e-9) continue;
      out.push_back(judged("Dynamic world, " + scene + ", step 2 ms (the longest near others)",
                           "within 1 % of the way of the " + row.against + " run",
                           text(1e3 * row.error) + " mm = " + text(100.0 * row.error_share) + " %",
                           row.error_share <= 0.01));
    }
  }
}

void contact_extremes(const Measurements& m, std::vector<Verdict>& out) {
  for (const char* mode : {"stop", "dynamic"}) {
    ExtremeOutcome worst;
    int cells = 0, held = 0;
    for (const ExtremeRow& row : m.extremes) {
      if (row.contact != mode) continue;
      ++cells;
      held += row.outcome.held();
      worst.penetration = std::max(worst.penetration, row.outcome.penetration);
      worst.energy_gained = std::max(worst.energy_gained, row.outcome.energy_gained);
    }
    if (cells == 0) continue;
    out.push_back(judged(
        std::string("Contact at its extremes, ") + mode,
        "every cell finite, bounded, ≤ 0.1 mm deep, gains no more energy than 3 µm of depth are worth, none refused",
        std::to_string(held) + " of " + std::to_string(cells) + " cells; deepest " + text(1e3 * worst.penetration) +
            " mm, most gained " + text(1e6 * worst.energy_gained) + " µm",
        held == cells));
  }
}

}  // namespace

std::string name_of(Verdict::Result result) {
  switch (result) {
    case Verdict::Result::pass:
      return "PASS";
    case Verdict::Result::fail:
      return "FAIL";
    case Verdict::Result::not_measured:
      break;
  }
  return "–";
}

std::vector<Verdict> verdicts(const Measurements& measured) {
  std::vector<Verdict> out;
  for (const char* scene : {"A", "B"}) one_step_per_sample(measured, scene, out);
  for (const char* scene : {"A", "B"}) beats_every_peer(measured, scene, out);
  scene_c(measured, out);
  sketch(measured, out);
  rods(measured, out);
  cost_of_a_step(measured, out);
  shapes(measured, out);
  tolerance(measured, out);
  model_errors(measured, out);
  contact(measured, out);
  contact_extremes(measured, out);
  stability(measured, out);
  const double limit = measured.quick ? 60.0 : 1200.0;
  out.push_back(judged(measured.quick ? "report --quick" : "report", "under " + text(limit / 60.0) + " min",
                       text(measured.seconds) + " s", measured.seconds < limit));
  return out;
}

std::string verdicts_csv(const std::vector<Verdict>& verdicts) {
  std::ostringstream out;
  out << "claim,target,measured,verdict\n";
  const auto quoted = [](std::string cell) {
    for (std::size_t i = 0; (i = cell.find('"', i)) != std::string::npos; i += 2) cell.insert(i, 1, '"');
    return '"' + cell + '"';
  };
  for (const Verdict& v : verdicts) {
    out << quoted(v.claim) << ',' << quoted(v.target) << ',' << quoted(v.measured) << ',' << name_of(v.result) << '\n';
  }
  return out.str();
}

}  // namespace spring_workbench::benchmark
