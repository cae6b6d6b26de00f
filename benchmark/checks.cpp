#include "benchmark/checks.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <map>
#include <set>
#include <sstream>

#include "benchmark/comparison.h"
#include "benchmark/our_methods.h"
#include "spring_workbench/dynamics/integrator.h"
#include "spring_workbench/validation/names.h"

namespace spring_workbench::benchmark {
namespace {

constexpr double kEvery50Hz = 0.02;
constexpr double kLargestShare = 0.1;  // fraction of the deflection; a coarser target says nothing about the spring
constexpr double kRepeatable = 1.6;    // by which the rounds of a report differ at most, but for one run in a thousand
constexpr double kFinest = 1e-13;      // [m or rad]; finer errors are rounding of the poses
constexpr const char* kFirstOfAll = "> 1 (up to 1.6: even, not judged)";
constexpr const char* kOurs = "exponential";
const ErrorMeasure kOfAmplitude = &ErrorRow::error_over_hand_amplitude;
const ErrorMeasure kOfDeflection = &ErrorRow::error_over_largest_deflection;

std::string text(double value, int digits = 3) {
  std::ostringstream out;
  out.precision(digits);
  out << value;
  return out.str();
}

Check judged(std::string claim, std::string target, std::string measured, bool held) {
  return {std::move(claim), std::move(target), std::move(measured), held ? Check::Result::pass : Check::Result::fail};
}

/// Whether the limit of one of our integrators is not the equation of motion.
bool has_own_law(const std::string& integrator) { return !solves_the_equation_of_motion(integrator); }
bool is_cvode(const std::string& method) { return method.find("cvode") != std::string::npos; }
bool is_solver(const std::string& method) { return method.rfind("hand_", 0) == 0 || method.rfind("solver_", 0) == 0; }
bool is_engine(const std::string& method) { return !is_cvode(method) && !is_solver(method); }
bool is_any(const std::string&) { return true; }
bool is_dop853_or_radau(const std::string& method) {
  return method.rfind("solver_dop853", 0) == 0 || method.rfind("solver_radau", 0) == 0;
}

std::string time_of(const std::optional<double>& time) { return time ? text(*time) + " µs/s" : "does not reach it"; }

std::string text_of(const Pair& pair, const ErrorTarget& target) {
  const bool ended = !pair.baseline_time && std::isfinite(pair.baseline_beyond);
  std::string figure = "ours " + time_of(pair.ours) + ", " + pair.baseline + ' ';
  figure +=
      ended ? "slower than " + text(pair.baseline_beyond) + " µs/s, where its line ends" : time_of(pair.baseline_time);
  if (pair.ours && (pair.baseline_time || ended))
    figure += (ended ? ": more than " : " = ") + text(*pair.ratio()) + "×";
  if (pair.error < target.error) figure += ", at " + text(pair.error) + ", since its line begins no earlier";
  return figure;
}

std::string named(const SceneRows& scene) {
  return (scene.rows[0].scene.size() == 1 ? "Scene " : "Rod ") + title_of(scene.rows[0]);
}

/// What a claim about errors that are finer than what the samples of the hand leave is about.
std::string integration_alone(const SceneRows& scene, const ErrorTarget& target) {
  const double left = scene.left_by_samples();
  if (scene.share_of_deflection(target) >= left) return "";
  return ", error of integration alone (of the deflection the samples leave " + text(left) + ")";
}

/// Names those of the baselines wanted that are not compared.
std::string without(const SceneRows& scene, const ErrorTarget& target,
                    const std::function<bool(const std::string&)>& wanted) {
  std::string names;
  for (const std::string& name : scene.not_compared(target, wanted)) names += (names.empty() ? "" : ", ") + name;
  return names.empty() ? "" : "; not compared, since their own limit is not known well enough: " + names;
}

/// Whether ours is first of all; not judged if it leads by no more than what run times differ by from run to run.
Check::Result first_by(double ratio) {
  if (ratio <= 1.0) return Check::Result::fail;
  return ratio >= kRepeatable ? Check::Result::pass : Check::Result::not_measured;
}

/// Compares ours with the best of some baselines: the ratio of run times must be at least `least`; 1: ours must be
/// first.
Check against(const SceneRows& scene, const ErrorTarget& target, const std::string& whom,
              const std::function<bool(const std::string&)>& wanted, double least) {
  const bool every = least == 1.0;
  Check check{named(scene) + ", at " + target.text() + integration_alone(scene, target) + ": run time of " + whom +
                  " over ours",
              every ? kFirstOfAll : "≥ " + text(least) + "×", ""};
  const double share = scene.share_of_deflection(target);
  const std::vector<Pair> pairs = scene.pairs(target, wanted);
  if (pairs.empty()) {
    check.measured = "not judged: none of them was found, or none has a limit that is known well enough";
  } else if (share > kLargestShare) {
    check.measured =
        "not judged: that is " + text(100.0 * share) + " % of the largest deflection; " + text_of(pairs[0], target);
  } else if (scene.length_of(target) < kFinest) {
    check.measured = "not judged: that is " + text(scene.length_of(target)) + " m, and poses are rounded; " +
                     text_of(pairs[0], target);
  } else if (target.error < min_of_reference * scene.uncertainty(target)) {
    check.measured =
        "not judged: the reference is known to " + text(scene.uncertainty(target)) + "; " + text_of(pairs[0], target);
  } else if (!pairs[0].ratio()) {
    check.measured = "no one reaches it";
  } else if (!scene.anyone_arrives(wanted)) {
    check.measured = "not judged: none of them has a run that arrived";
  } else {
    check.measured = text_of(pairs[0], target);
    const double ratio = *pairs[0].ratio(), left = scene.left_by_samples();
    check.ratio = ratio;
    check.baseline = pairs[0].baseline;
    check.error = pairs[0].error;
    check.within = scene.ratio_within(target, wanted);
    if (left > 0.0) check.left_by_samples = left;
    check.result = every ? first_by(ratio) : ratio >= least ? Check::Result::pass : Check::Result::fail;
    if (!every && ratio >= least && ratio < kRepeatable * least)
      check.measured += "; another run may miss it, since run times differ by up to " + text(kRepeatable) + "×";
  }
  check.measured += without(scene, target, wanted);
  return check;
}

/// Errors from a tenth of the largest deflection down to `least`, two per decade.
std::vector<double> errors_down_to(double least) {
  std::vector<double> errors;
  for (double decade = kLargestShare; decade > 1e-12; decade *= 0.1)
    errors.insert(errors.end(), {decade, 0.3 * decade});
  errors.erase(std::remove_if(errors.begin(), errors.end(), [&](double e) { return e <= 1.001 * least; }),
               errors.end());
  errors.push_back(least);
  return errors;
}

/// Compares ours with all at the errors that the samples allow: from a tenth of the largest deflection down to what
/// they leave open. If that is more, or not known, down to a thousandth: the error of integration alone.
Check at_every_error(const SceneRows& scene, const std::string& whom) {
  const double left = scene.left_by_samples();
  const bool allows_some = left > 0.0 && left <= kLargestShare;
  const std::vector<double> errors = errors_down_to(allows_some ? left : 1e-3);
  const std::string range =
      allows_some ? "at every error that the samples allow, " + text(left) + " of the largest deflection and more"
                  : "at every error from a tenth to a thousandth of the largest deflection, of integration alone (" +
                        (left > 0.0 ? "the samples leave " + text(left) : "what the samples leave is not known") + ')';
  Check check{named(scene) + ", " + range + ": run time of " + whom + " over ours", kFirstOfAll, ""};
  int judged = 0;
  bool too_fine = false;
  std::string lost;
  for (const double error : errors) {
    const ErrorTarget target{error, kOfDeflection};
    const std::vector<Pair> pairs = scene.pairs(target, is_any);
    too_fine = too_fine || scene.length_of(target) < kFinest;
    if (pairs.empty() || !pairs[0].ratio() || too_fine) continue;
    ++judged;
    check.ratio = std::min(check.ratio.value_or(*pairs[0].ratio()), *pairs[0].ratio());
    if (*pairs[0].ratio() <= 1.0) lost += (lost.empty() ? "" : "; ") + text(error) + ": " + text_of(pairs[0], target);
  }
  check.measured = judged == 0 ? "no one reaches any"
                   : lost.empty()
                       ? "first at all " + std::to_string(judged) + ", by " + text(*check.ratio) + "× at least"
                       : "of " + std::to_string(judged) + " lost at " + lost;
  if (judged > 0) check.result = first_by(*check.ratio);
  if (too_fine) check.measured += "; below " + text(kFinest) + " m not judged, since poses are rounded";
  check.measured += without(scene, {errors.back(), kOfDeflection}, is_any);
  return check;
}

/// The stiffnesses of a scene that were run (few with --quick).
std::string text_of(const std::set<double>& factors) {
  std::string list;
  for (const double factor : factors) list += (list.empty() ? "stiffness × " : ", ") + text(factor);
  return list;
}

void one_step_per_sample(const Measurements& m, const std::string& scene, std::vector<Check>& out) {
  const std::string unit = scene == "A" ? " m" : " rad";
  for (const char* hand : {"samples", "function"}) {
    std::set<double> factors;
    double integration = 0.0, left = 0.0;
    bool finite = true;
    for (const ErrorRow& row : m.scenes) {
      if (row.scene != scene || row.method != kOurs || row.hand != hand || std::abs(row.step - kEvery50Hz) > 1e-9)
        continue;
      factors.insert(row.stiffness_factor);
      finite = finite && row.finite;
      integration = std::max(integration, row.error);
      left = std::max(left, row.hand_error);
    }
    if (factors.empty()) continue;
    const bool sampled = std::string(hand) == "samples";
    const std::string what = sampled ? "hand by the poses of a 50 Hz tracker, error with what these leave open"
                                     : "hand a function of time, of which it is given the pose at the end of each step";
    const std::string figure = text(integration + left) + unit;
    out.push_back(judged("Scene " + scene + ", " + kOurs + ", one step per 20 ms, " + text_of(factors) + "; " + what,
                         "error ≤ 1e-6" + unit,
                         sampled ? figure + ", of which integration " + text(integration) + unit : figure,
                         finite && integration + left <= 1e-6));
  }
}

/// The errors at which all methods are compared.
const std::vector<ErrorTarget>& targets() {
  static const std::vector<ErrorTarget> all = {
      {1e-6, kOfAmplitude}, {1e-3, kOfDeflection}, {1e-9, kOfAmplitude}, {1e-12, kOfAmplitude}};
  return all;
}

/// Whether a fork is stiff, itself or for its load (README.md, Rods): the motion depends on stiffness over mass. In B,
/// ω = 447 rad/s at × 1, more than in C at × 100.
bool is_stiff(const ErrorRow& row) {
  return row.stiffness_factor * std::max(1.0, 5.0 / row.mass) >= (row.scene == "B" ? 1.0 : 100.0);
}

/// By how much ours should be faster than the best engine.
void against_engines(const SceneRows& scene, const ErrorTarget& target, std::vector<Check>& out) {
  out.push_back(against(scene, target, "the best engine", is_engine, is_stiff(scene.rows[0]) ? 50.0 : 20.0));
}

/// The same for CVODE.
void against_cvode(const SceneRows& scene, const ErrorTarget& target, std::vector<Check>& out) {
  out.push_back(against(scene, target, "CVODE in any form", is_cvode, is_stiff(scene.rows[0]) ? 20.0 : 2.0));
}

/// How many comparisons with every baseline would end otherwise if run times between two settings were not used.
void without_interpolation(std::vector<SceneRows> scenes, std::vector<Check>& out) {
  int worse = 0, better = 0, count = 0;
  const auto rank = [](const Check& v) { return v.result == Check::Result::fail ? 0 : v.ratio < kRepeatable ? 1 : 2; };
  for (SceneRows& scene : scenes) {
    for (const ErrorTarget& target : targets()) {
      scene.interpolates = true;
      const Check as_judged = against(scene, target, "every baseline", is_any, 1.0);
      scene.interpolates = false;
      const Check measured = against(scene, target, "every baseline", is_any, 1.0);
      if (!as_judged.ratio || !measured.ratio) continue;
      ++count;
      worse += rank(measured) < rank(as_judged);
      better += rank(measured) > rank(as_judged);
    }
  }
  if (count == 0) return;
  out.push_back({"Comparisons with every baseline, from measured settings alone, without run times between two of them",
                 "(not a target)",
                 "compared " + std::to_string(count) + "; worse for ours " + std::to_string(worse) +
                     "; better for ours " + std::to_string(better)});
}

void against_baselines(const SceneRows& scene, std::vector<Check>& out) {
  const ErrorRow& first = scene.rows[0];
  const bool sampled = first.hand == "samples";
  for (const ErrorTarget& target : targets()) out.push_back(against(scene, target, "every baseline", is_any, 1.0));
  if (sampled) out.push_back(at_every_error(scene, "every baseline"));
  if (!sampled && !is_stiff(first))
    out.push_back(against(scene, {1e-9, kOfAmplitude}, "DOP853 and Radau IIA", is_dop853_or_radau, 1.0));
  for (const ErrorTarget& target : {targets()[0], targets()[1]}) {
    against_engines(scene, target, out);
    against_cvode(scene, target, out);
  }
}

/// By how much the two rounds of a run differ in the run times that are compared.
void repeatability(const Measurements& m, std::vector<Check>& out) {
  std::vector<double> ratios;
  for (const std::vector<ErrorRow>* rows : {&m.scenes, &m.rods}) {
    for (const ErrorRow& row : *rows) {
      if (row.other_wall_us > 0.0) ratios.push_back(row.other_wall_us / row.wall_us_per_simulated_second);
    }
  }
  if (ratios.empty()) return;
  std::sort(ratios.begin(), ratios.end());
  const auto beyond = std::distance(std::upper_bound(ratios.begin(), ratios.end(), kRepeatable), ratios.end());
  Check check{"Run times of a method and setting, the slower round over the faster", "(not a target)",
              "median " + text(ratios[ratios.size() / 2]) + "; 95 % below " + text(ratios[ratios.size() * 95 / 100]) +
                  "; most " + text(ratios.back()) + "; more than " + text(kRepeatable) + " in " +
                  text(100.0 * static_cast<double>(beyond) / static_cast<double>(ratios.size())) + " % of " +
                  std::to_string(ratios.size())};
  out.push_back(check);
}

/// Time of a step of MuJoCo's RK4 in scene C [µs], for comparing machines. Infinite if not measured.
double mujoco_step(const Measurements& m) {
  double least = std::numeric_limits<double>::infinity();
  for (const ErrorRow& row : m.scenes) {
    if (row.scene == "C" && row.method == "mujoco_rk4" && row.finite) {
      least = std::min(least, row.wall_us_per_simulated_second / row.steps_per_second);
    }
  }
  return least;
}

/// Times of the feasibility sketch, from another machine, scaled by the times of MuJoCo's step there and here.
void sketch(const Measurements& m, std::vector<Check>& out) {
  constexpr double there = 3.164;  // [µs]
  const double here = mujoco_step(m), slower = std::isfinite(here) ? here / there : 1.0;
  for (const auto& [factor, run_time] : {std::pair{1.0, 425.0}, std::pair{100.0, 42.0}}) {
    const auto wanted = [factor = factor](const ErrorRow& row) {
      return row.scene == "C" && row.stiffness_factor == factor && row.hand == "function" && row.method == kOurs;
    };
    if (std::none_of(m.scenes.begin(), m.scenes.end(), wanted)) continue;
    const auto ours = run_time_for_error(curve(m.scenes, wanted), 1e-6);
    out.push_back(
        judged("Scene C × " + text(factor) +
                   ", hand by function, at 1e-6: the feasibility sketch, scaled by MuJoCo's step here and there",
               "< " + text(run_time) + " × " + text(slower) + " = " + text(run_time * slower) + " µs/s", time_of(ours),
               ours && *ours < run_time * slower));
  }
}

/// The rods on a tracked hand that were run with general methods or engines, in the shapes of these runs.
std::vector<SceneRows> rods_with_baselines(const Measurements& m) {
  std::set<std::pair<std::string, std::string>> with_baselines;
  for (const ErrorRow& row : m.rods)
    if (!row.ours) with_baselines.emplace(row.scene, row.shape);
  std::vector<ErrorRow> rows;
  std::copy_if(m.rods.begin(), m.rods.end(), std::back_inserter(rows), [&](const ErrorRow& row) {
    return with_baselines.count({row.scene, row.shape}) > 0 && row.error_over_tolerance == 0.0;
  });
  return by_scene(rows);
}

void rod_against_baselines(const SceneRows& rod, std::vector<Check>& out) {
  for (const ErrorTarget& target : targets()) out.push_back(against(rod, target, "every baseline", is_any, 1.0));
  out.push_back(at_every_error(rod, "every baseline"));
  const auto is_of_engine = [](const ErrorRow& row) { return !row.ours && is_engine(row.method); };
  const bool has_engines = std::any_of(rod.rows.begin(), rod.rows.end(), is_of_engine);
  for (const ErrorTarget& target : {targets()[0], targets()[1]}) {
    if (has_engines) against_engines(rod, target, out);
    against_cvode(rod, target, out);
  }
}

/// One step per sample: the original requirement, and the later one of 2e-7 m for two rods.
void rods(const Measurements& m, std::vector<Check>& out) {
  for (const ErrorRow& row : m.rods) {
    if (row.method != kOurs || row.shape != "linear" || std::abs(row.step - kEvery50Hz) > 1e-9) continue;
    const std::string name = row.scene.substr(row.scene.rfind("recorded_", 0) == 0 ? 9 : 0);
    const bool heavy = name == "heavy_large_bend", soft = name == "soft_6dof";
    if (!heavy && !soft && name != "underdamped" && name != "stiff_6dof") continue;
    const double position = std::max(row.position_error, row.error_between);
    const std::string claim = "Rod " + row.scene + ", " + kOurs + ", steps of 20 ms at most, error of integration";
    const std::string figure = row.finite ? text(position) + " m, " + text(row.angle_error) + " rad, with " +
                                                text(row.steps_per_second) + " steps a second"
                                          : "not finite";
    out.push_back(judged(claim, heavy ? "within 1e-4 m" : "within 1e-5 m and 1e-4 rad", figure,
                         row.finite && (heavy ? position <= 1e-4 : position <= 1e-5 && row.angle_error <= 1e-4)));
    if (heavy || soft) out.push_back(judged(claim, "within 2e-7 m", figure, row.finite && position <= 2e-7));
  }
}

void cost_of_a_step(const Measurements& m, std::vector<Check>& out) {
  double ours = 0.0;
  for (const ErrorRow& row : m.rods) {
    if (row.scene == "soft_6dof" && row.shape == "linear" && row.method == kOurs && row.finite &&
        std::abs(row.step - kEvery50Hz) < 1e-9) {
      ours = kEvery50Hz * row.wall_us_per_simulated_second;
    }
  }
  const double baseline = mujoco_step(m);
  const std::string claim = "20 ms of the rod (soft_6dof, linear, exponential, steps of 20 ms at most, with its hand)";
  const std::string target = "≤ 2 MuJoCo RK4 steps of scene C";
  if (ours > 0.0 && std::isfinite(baseline)) {
    out.push_back(judged(claim, target, text(ours) + " µs; MuJoCo " + text(baseline) + " µs", ours <= 2.0 * baseline));
  } else {
    out.push_back({claim, target, "not measured", Check::Result::not_measured});
  }
}

/// What runs of `method` to a tolerance cost and how far below it they end, beside fixed steps on the same rod.
void tolerance_beside_steps(const Measurements& m, const std::string& method, std::vector<Check>& out) {
  int kept = 0, longest_already = 0, count = 0, cheap = 0, compared = 0;
  double dearest = 0.0;
  std::string where;
  for (const ErrorRow& row : m.rods) {
    if (row.tolerance <= 0.0 || row.method != method) continue;
    ++count;
    if (!row.finite) {
      ++compared;  // it took too long
      continue;
    }
    const auto beside = [&](const ErrorRow& other) {
      return other.scene == row.scene && other.shape == row.shape && other.method == method && other.step > 0.0;
    };
    double longest = std::numeric_limits<double>::infinity();  // steps that a second takes with the longest ones
    for (const ErrorRow& other : m.rods) {
      if (beside(other) && other.finite) longest = std::min(longest, other.steps_per_second);
    }
    const bool longer_are_open = row.steps_per_second > longest;
    longest_already += !longer_are_open;
    kept += row.error_over_tolerance <= 3.0 && (row.error_over_tolerance >= 0.01 || !longer_are_open);
    // The tolerance is of the position at the outputs.
    const auto fixed = run_time_for_error(curve(m.rods, beside, &ErrorRow::position_error), row.position_error);
    if (!fixed || row.position_error <= 0.0) continue;
    const double ratio = row.wall_us_per_simulated_second / *fixed;
    ++compared;
    cheap += ratio <= 1.5;
    if (ratio > dearest) where = row.scene + ", " + row.shape + ", " + text(row.tolerance);
    dearest = std::max(dearest, ratio);
  }
  const std::string claim = "Tolerance mode, " + method + ", all rods";
  out.push_back(judged(claim + ", errors of the runs", "≤ 3 × the tolerance; ≥ 0.01 × where longer steps were open",
                       std::to_string(kept) + " of " + std::to_string(count) + "; no longer steps were open to " +
                           std::to_string(longest_already) + " of them",
                       kept == count));
  if (compared == 0) return;
  out.push_back(
      judged(claim + ", run time", "≤ 1.5 × that of fixed steps with the same error of position at the outputs",
             std::to_string(cheap) + " of " + std::to_string(compared) + "; at most " + text(dearest) + "× (" + where +
                 "); " + std::to_string(count - compared) + " not compared, since no fixed step is as exact",
             cheap == compared));
}

void tolerance(const Measurements& m, std::vector<Check>& out) {
  std::set<std::string> methods;
  for (const ErrorRow& row : m.rods) {
    if (row.tolerance > 0.0 && row.ours) methods.insert(row.method);
  }
  for (const std::string& method : methods) {
    double least = std::numeric_limits<double>::infinity(), largest = 0.0;
    int within = 0, not_above = 0, count = 0, given_up = 0;
    for (const ErrorRow& row : m.rods) {
      if (row.tolerance <= 0.0 || row.method != method) continue;
      ++count;
      given_up += row.given_up;
      if (!row.finite) continue;
      least = std::min(least, row.error_over_tolerance);
      largest = std::max(largest, row.error_over_tolerance);
      not_above += row.error_over_tolerance <= 3.0;
      within += row.error_over_tolerance <= 3.0 && row.error_over_tolerance >= 1.0 / 3.0;
    }
    const std::string what = std::string(has_own_law(method) ? ", all rods, of its own limit" : ", all rods") +
                             ", at the outputs, angles by the radius of gyration";
    out.push_back(judged("Tolerance mode, " + method + what,
                         "every error within a factor of 3 of what was asked, both ways",
                         std::to_string(within) + " of " + std::to_string(count) + "; " + std::to_string(not_above) +
                             " no more than 3 above; " + text(least) + " … " + text(largest) + " of it; " +
                             std::to_string(given_up) + " took too long",
                         within == count));
    tolerance_beside_steps(m, method, out);
  }
}

/// Distance of an integrator's own limit from the exact motion.
void model_errors(const Measurements& m, std::vector<Check>& out) {
  std::map<std::string, std::vector<const ErrorRow*>> rows_of;
  for (const ErrorRow& row : m.rods) {
    if (row.ours && has_own_law(row.method) && row.finite) rows_of[row.method].push_back(&row);
  }
  for (const auto& [method, rows] : rows_of) {
    const auto less = [](const ErrorRow* a, const ErrorRow* b) { return a->model_error < b->model_error; };
    const auto [least, most] = std::minmax_element(rows.begin(), rows.end(), less);
    out.push_back(
        {"Model error of " + method + ", all rods: how far its limit for short steps is from the exact motion",
         "none: what the scheme leaves out",
         text((*least)->model_error) + " m (" + (*least)->scene + ") … " + text((*most)->model_error) + " m (" +
             (*most)->scene + ')',
         Check::Result::not_measured});
  }
}

void stability(const Measurements& m, std::vector<Check>& out) {
  for (const std::string& name : validation::names<dynamics::IntegratorKind>()) {
    StabilityRow sum;
    for (const StabilityRow& row : m.map.rows) {
      if (row.integrator == name) add(row, sum);
    }
    if (sum.cells == 0) continue;
    const auto kind = validation::named<dynamics::IntegratorKind>(name, "benchmark", "integrator");
    const std::string of_cells = " of " + std::to_string(sum.cells) + " cells";
    const std::string figure =
        std::to_string(sum.held) + of_cells + " hold, " + std::to_string(sum.on_its_own) +
        " of them on their own, without shorter steps, a stop or the fallback; energy was judged to the end in " +
        std::to_string(sum.energy_judged) + ", where it grew by at most " + text(sum.energy_growth) +
        " beyond the estimates, which came to at most " + text(sum.energy_estimated) + ", and in " +
        std::to_string(sum.within_rounding) + " by at most 1e-9 without allowing for them" + "; of " + text(sum.steps) +
        " steps " + text(sum.fallback) + " by the fallback, " + text(sum.stops) + " at a stop, " + text(sum.substeps) +
        " repeated as shorter ones";
    const std::string claim = "Stability map, " + name;
    const bool stiffly_stable = dynamics::make_integrator(kind)->stiffly_stable();
    if (has_own_law(name)) {
      out.push_back(
          {claim + " (its energy, that of another law, is not judged)", "none", figure, Check::Result::not_measured});
    } else if (stiffly_stable) {
      out.push_back(judged(
          claim,
          "every cell stays finite and, unless the hand turns to the end, within reach, no step is rejected, and, "
          "while the hand rests or trembles, no energy is gained beyond the hand's work but what the steps "
          "estimate, a hundredth at most (not judged while the hand turns, and if its work is not known to a "
          "hundredth)",
          figure, sum.held == sum.cells));
    } else {
      out.push_back({claim + " (a baseline with a stability limit)", "none", figure, Check::Result::not_measured});
      continue;
    }
    out.push_back(judged(claim + ": processor time",
                         "below the simulated time in 99 % of the cells, below three times that in all",
                         std::to_string(sum.real_time) + " and " + std::to_string(sum.three_times) + of_cells,
                         sum.real_time >= 0.99 * sum.cells && sum.three_times == sum.cells));
  }
}

/// Cost of changes at run time, as a multiple of an advance without one.
void cost_of_a_change(const Measurements& m, std::vector<Check>& out) {
  constexpr double kTimes = 3.0;
  double usual = 0.0;
  for (const StepCost& cost : m.step_costs) {
    if (cost.shape == "linear" && cost.part == "advance by 20 ms") usual = cost.nanoseconds;
  }
  for (const StepCost& cost : m.step_costs) {
    if (cost.shape != "linear" || cost.part.rfind("advance after", 0) != 0 || usual == 0.0) continue;
    const double micros = 1e-3 * cost.nanoseconds, times = cost.nanoseconds / usual;
    const std::string claim = "Simulation, default fork, " + cost.part + ", and one without";
    const std::string figure = text(micros) + " and " + text(1e-3 * usual) + " µs = " + text(times) + "×";
    out.push_back(judged(claim, "at most " + text(kTimes) + " times as long", figure, times <= kTimes));
  }
}

void shapes(const Measurements& m, std::vector<Check>& out) {
  constexpr double target = 1.2e-3;  // the table of the model, with its rounding
  for (const ElasticaRow& row : m.elastica) {
    if (row.shape != "linear" || row.alpha != 2.0) continue;
    out.push_back(judged("Part: shape linear against the exact elastica at P L²/EI = 2",
                         "tip within " + text(target) + " L", text(row.tip_error) + " L", row.tip_error <= target));
  }
}

std::set<std::string> scenes_of(const std::vector<MotionStepRow>& rows) {
  std::set<std::string> scenes;
  for (const MotionStepRow& row : rows) scenes.insert(row.scene);
  return scenes;
}

/// Motions in contact: the error at 2 ms, and its convergence order below.
void orders(const Measurements& m, const std::string& scene, std::vector<Check>& out) {
  const MotionStepRow *longest = nullptr, *shortest = nullptr;
  for (const MotionStepRow& row : m.contact.motion_steps) {
    if (row.scene != scene || row.step > 2.001e-3) continue;
    if (longest == nullptr || row.step > longest->step) longest = &row;
    if (shortest == nullptr || row.step < shortest->step) shortest = &row;
  }
  if (longest == nullptr) return;
  const std::string claim = "Motion in contact, " + scene;
  const std::string figure = text(1e3 * longest->error) + " mm = " + text(100.0 * longest->error_share) + " %";
  if (longest->against != "exact") {
    out.push_back({claim + ", step 2 ms, against a run of ours with steps of 0.1 ms, which is no reference", "none",
                   figure, Check::Result::not_measured});
    return;
  }
  out.push_back(
      judged(claim + ", step 2 ms", "within 1 % of the way of the exact run", figure, longest->error_share <= 0.01));
  if (shortest == longest) return;
  const double order = std::log(longest->error / shortest->error) / std::log(longest->step / shortest->step);
  out.push_back(judged(
      claim + ", steps from " + text(1e3 * longest->step) + " to " + text(1e3 * shortest->step) + " ms",
      "order ≥ 1.8 towards the exact run",
      text(order) + ": " + text(1e3 * longest->error) + " to " + text(1e3 * shortest->error) + " mm", order >= 1.8));
}

constexpr double kLagError = 1e-3, kDepth = 1e-5;  // of the lag, [m]: what is asked of the drag

/// The cheapest run of the drag that keeps the lag and the depth asked, with one of the methods `wanted`; the box can
/// turn. None if there is none.
const DragRow* cheapest_drag(const Measurements& m, double factor,
                             const std::function<bool(const std::string&)>& wanted) {
  const DragRow* cheapest = nullptr;
  for (const DragRow& row : m.contact.drags) {
    const bool keeps = row.finite && row.turns && row.lag_error <= kLagError && row.penetration <= kDepth;
    if (!keeps || row.stiffness_factor != factor || !wanted(row.method)) continue;
    if (cheapest == nullptr || row.cpu_us_per_simulated_second < cheapest->cpu_us_per_simulated_second) cheapest = &row;
  }
  return cheapest;
}

/// Run time of the drag in one of our modes and in the best engine.
void drag_run_time(const Measurements& m, const std::string& mode, double factor, std::vector<Check>& out) {
  const DragRow* ours = cheapest_drag(m, factor, [&](const std::string& method) { return method == mode; });
  const DragRow* engine =
      cheapest_drag(m, factor, [](const std::string& method) { return method != "stop" && method != "dynamic"; });
  Check check{"Drag, contact " + mode + ", stiffness × " + text(factor) +
                  ", lag within 0.1 %, penetration ≤ 0.01 mm: run time of the best engine over ours",
              "> 1", "no one keeps both"};
  const auto told = [](const std::string& name, const DragRow* row) {
    return name + (row == nullptr ? " does not" : ' ' + text(row->cpu_us_per_simulated_second) + " µs/s");
  };
  if (ours != nullptr || engine != nullptr) {
    const double none = std::numeric_limits<double>::infinity();
    check.ratio = ours == nullptr     ? 0.0
                  : engine == nullptr ? none
                                      : engine->cpu_us_per_simulated_second / ours->cpu_us_per_simulated_second;
    check.measured = told("ours", ours) + ", " + told(engine == nullptr ? "any engine" : engine->method, engine);
    if (ours != nullptr && engine != nullptr) check.measured += " = " + text(*check.ratio) + "×";
    check.result = *check.ratio > 1.0 ? Check::Result::pass : Check::Result::fail;
  }
  out.push_back(check);
}

void contact(const Measurements& m, std::vector<Check>& out) {
  for (const char* mode : {"stop", "dynamic"}) {
    std::set<double> factors;
    double lag = 0.0, depth = 0.0;
    bool finite = true;
    for (const DragRow& row : m.contact.drags) {
      if (row.method != mode) continue;
      factors.insert(row.stiffness_factor);
      finite = finite && row.finite;
      lag = std::max(lag, row.lag_error);
      depth = std::max(depth, row.penetration);
    }
    if (factors.empty()) continue;
    out.push_back(judged(std::string("Drag, contact ") + mode + ", steps of 20 to 1 ms, " + text_of(factors),
                         "lag within 0.1 %, penetration ≤ 0.01 mm",
                         finite ? text(100.0 * lag) + " %, " + text(1e3 * depth) + " mm" : "not finite",
                         finite && lag <= kLagError && depth <= kDepth));
    for (const double factor : factors) drag_run_time(m, mode, factor, out);
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
    out.push_back(judged("Part: pose of first contact, " + name + ", ways of 40 mm", "within 0.01 mm, no way through",
                         text(1e3 * largest) + " mm, " + std::to_string(through) + " through",
                         largest <= 1e-5 && through == 0));
  }
  for (const std::string& scene : scenes_of(m.contact.motion_steps)) orders(m, scene, out);
}

void contact_limit_cases(const Measurements& m, std::vector<Check>& out) {
  for (const char* mode : {"stop", "dynamic"}) {
    LimitCaseOutcome worst;
    int cells = 0, held = 0, blocked = 0, unsolved = 0;
    for (const LimitCaseRow& row : m.limit_cases) {
      if (row.contact != mode) continue;
      ++cells;
      unsolved += row.outcome.steps_unsolved;
      blocked += row.outcome.steps_blocked;
      held += row.outcome.held();
      worst.penetration = std::max(worst.penetration, row.outcome.penetration);
      worst.energy_gained = std::max(worst.energy_gained, row.outcome.energy_gained);
    }
    if (cells == 0) continue;
    out.push_back(
        judged(std::string("Limit cases of contact, ") + mode,
               "every cell finite, bounded, ≤ 0.1 mm deep, gains no more energy than 3 µm of depth are worth, no step "
               "rejected, blocked or unsolved",
               std::to_string(held) + " of " + std::to_string(cells) + " cells; deepest " +
                   text(1e3 * worst.penetration) + " mm, most gained " + text(1e6 * worst.energy_gained) + " µm; " +
                   std::to_string(blocked) + " steps blocked, " + std::to_string(unsolved) + " unsolved",
               held == cells));
  }
}

void contact_map(const Measurements& m, std::vector<Check>& out) {
  for (const std::string& obstacle : map_scenes()) {
    MapRow worst;
    int cells = 0, held = 0, slow = 0;
    for (const MapRow& row : m.contact_map) {
      if (row.obstacle != obstacle) continue;
      ++cells;
      held += row.holds();
      slow += row.times_real > 1.0;
      worst.depth = std::max(worst.depth, row.depth);
      worst.moved = std::max(worst.moved, row.moved);
      worst.times_real = std::max(worst.times_real, row.times_real);
      worst.steps_blocked += row.steps_blocked;
      worst.steps_unsolved += row.steps_unsolved;
    }
    if (cells == 0) continue;
    out.push_back(
        judged("Map of contact, " + obstacle,
               "every cell finite, within 0.5 m, ≤ 0.1 mm deep, no step rejected, blocked or unsolved, below three "
               "times real time; 99 % below real time",
               std::to_string(held) + " of " + std::to_string(cells) + " cells; farthest " + text(worst.moved) +
                   " m, deepest " + text(1e3 * worst.depth) + " mm, " + std::to_string(worst.steps_blocked) +
                   " steps blocked, " + std::to_string(worst.steps_unsolved) + " unsolved, up to " +
                   text(worst.times_real) + "× real time, " + std::to_string(slow) + " cells above it",
               held == cells && 100 * slow <= cells));
  }
}

}  // namespace

std::string name_of(Check::Result result) {
  switch (result) {
    case Check::Result::pass:
      return "PASS";
    case Check::Result::fail:
      return "FAIL";
    case Check::Result::not_measured:
      break;
  }
  return "–";
}

std::vector<Check> checks(const Measurements& measured) {
  std::vector<Check> out;
  for (const char* scene : {"A", "B"}) one_step_per_sample(measured, scene, out);
  const std::vector<SceneRows> scenes = by_scene(measured.scenes);
  for (const char* hand : {"samples", "function"}) {
    for (const SceneRows& scene : scenes) {
      if (scene.rows[0].hand == hand) against_baselines(scene, out);
    }
  }
  repeatability(measured, out);
  sketch(measured, out);
  const std::vector<SceneRows> rods_compared = rods_with_baselines(measured);
  for (const SceneRows& rod : rods_compared) rod_against_baselines(rod, out);
  std::vector<SceneRows> compared = scenes;
  compared.insert(compared.end(), rods_compared.begin(), rods_compared.end());
  without_interpolation(std::move(compared), out);
  rods(measured, out);
  cost_of_a_step(measured, out);
  cost_of_a_change(measured, out);
  shapes(measured, out);
  tolerance(measured, out);
  model_errors(measured, out);
  contact(measured, out);
  contact_limit_cases(measured, out);
  contact_map(measured, out);
  stability(measured, out);
  const double limit = measured.quick ? 60.0 : 1200.0;
  out.push_back(judged(measured.quick ? "report --quick" : "report", "under " + text(limit / 60.0) + " min",
                       text(measured.seconds) + " s from its begin to the last picture, " +
                           text(measured.processor_seconds) + " s of processor time",
                       measured.seconds < limit));
  return out;
}

std::string checks_csv(const std::vector<Check>& checks) {
  std::ostringstream out;
  out << "claim,target,measured,result,ratio,baseline,error,ratio_within,left_by_samples\n";
  const auto quoted = [](std::string cell) {
    for (std::size_t i = 0; (i = cell.find('"', i)) != std::string::npos; i += 2) cell.insert(i, 1, '"');
    return '"' + cell + '"';
  };
  for (const Check& v : checks) {
    out << quoted(v.claim) << ',' << quoted(v.target) << ',' << quoted(v.measured) << ',' << name_of(v.result);
    const auto add = [&](const std::optional<double>& number) { out << ',' << (number ? text(*number) : ""); };
    add(v.ratio);
    out << ',' << v.baseline;
    for (const auto& number : {v.error, v.within, v.left_by_samples}) add(number);
    out << '\n';
  }
  return out.str();
}

}  // namespace spring_workbench::benchmark
