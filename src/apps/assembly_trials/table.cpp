#include "table.h"

#include <cmath>
#include <cstdio>
#include <functional>
#include <limits>

#include "spring_workbench/math/student_t.h"

namespace spring_workbench::assembly_trials {
namespace {

/// The 97.5 % quantile of Student's t distribution, of n − 1 degrees of freedom for n trials.
double quantile(double degrees_of_freedom) { return math::student_t_quantile(degrees_of_freedom, 0.975); }

std::string text(const char* format, double a, double b, double c = 0.0) {
  char buffer[80];
  std::snprintf(buffer, sizeof buffer, format, a, b, c);
  return buffer;
}

/// Mean and half width of its confidence interval.
std::string mean(const std::vector<assembly::TaskScore>& scores, double scale,
                 const std::function<double(const assembly::TaskScore&)>& value) {
  const double n = static_cast<double>(scores.size());
  double sum = 0.0, squares = 0.0;
  for (const assembly::TaskScore& s : scores) sum += scale * value(s);
  for (const assembly::TaskScore& s : scores) squares += std::pow(scale * value(s) - sum / n, 2);
  if (n < 2.0) return text("%.3g", sum / n, 0.0);
  return text("%.3g ± %.2g", sum / n, quantile(n - 1.0) * std::sqrt(squares / (n - 1.0) / n));
}

std::string completed(const std::vector<assembly::TaskScore>& scores) {
  const double n = static_cast<double>(scores.size());
  const double z = quantile(std::numeric_limits<double>::infinity()), zz = z * z;  // of the normal distribution
  double done = 0.0;
  for (const assembly::TaskScore& s : scores) done += s.complete() ? 1.0 : 0.0;
  const double p = done / n;
  const double centre = (p + zz / (2.0 * n)) / (1.0 + zz / n);
  const double half = z * std::sqrt(p * (1.0 - p) / n + zz / (4.0 * n * n)) / (1.0 + zz / n);
  return text("%.0f %% (%.0f … %.0f)", 100.0 * p, 100.0 * (centre - half), 100.0 * (centre + half));
}

}  // namespace

std::string means_csv(const std::vector<ToolTrials>& tools) {
  struct Column {
    const char* title;
    double scale;
    std::function<double(const assembly::TaskScore&)> value;
  };
  using Score = assembly::TaskScore;
  const Column columns[] = {{"placed", 1.0, &Score::placed},
                            {"time [s]", 1.0, &Score::time},
                            {"hand path [m]", 1.0, &Score::hand_path},
                            {"object path [m]", 1.0, &Score::object_path},
                            {"grasps", 1.0, &Score::grasps},
                            {"collisions", 1.0, &Score::collisions},
                            {"drops", 1.0, &Score::drops},
                            {"broken", 1.0, &Score::broken},
                            {"largest force [N]", 1.0, &Score::largest_force},
                            {"placement error [mm]", 1e3, &Score::position_error}};
  std::string table = "tool,trials,completed";
  for (const Column& column : columns) table += std::string(",") + column.title;
  table += "\n";
  for (const auto& [label, scores] : tools) {
    table += label + "," + std::to_string(scores.size()) + "," + completed(scores);
    for (const Column& column : columns) table += "," + mean(scores, column.scale, column.value);
    table += "\n";
  }
  return table;
}

}  // namespace spring_workbench::assembly_trials
