#include "table.h"

#include <cmath>
#include <cstdio>
#include <functional>

namespace spring_workbench::assembly_trials {
namespace {

constexpr double normal_quantile = 1.959964;  // of 97.5 %

/// 97.5 % quantile of Student's t, by Cornish and Fisher's expansion: to three digits from 4 degrees of freedom on.
double student_quantile(double degrees) {
  const double z = normal_quantile, z3 = z * z * z, z5 = z3 * z * z, z7 = z5 * z * z;
  return z + (z3 + z) / (4.0 * degrees) + (5.0 * z5 + 16.0 * z3 + 3.0 * z) / (96.0 * degrees * degrees) +
         (3.0 * z7 + 19.0 * z5 + 17.0 * z3 - 15.0 * z) / (384.0 * degrees * degrees * degrees);
}

std::string text(const char* format, double a, double b, double c = 0.0) {
  char buffer[80];
  std::snprintf(buffer, sizeof buffer, format, a, b, c);
  return buffer;
}

/// Mean and half width of its interval.
std::string mean(const std::vector<assembly::TaskScore>& scores, double scale,
                 const std::function<double(const assembly::TaskScore&)>& value) {
  const double n = static_cast<double>(scores.size());
  double sum = 0.0, squares = 0.0;
  for (const assembly::TaskScore& s : scores) sum += scale * value(s);
  for (const assembly::TaskScore& s : scores) squares += std::pow(scale * value(s) - sum / n, 2);
  if (n < 2.0) return text("%.3g", sum / n, 0.0);
  return text("%.3g ± %.2g", sum / n, student_quantile(n - 1.0) * std::sqrt(squares / (n - 1.0) / n));
}

std::string completed(const std::vector<assembly::TaskScore>& scores) {
  const double n = static_cast<double>(scores.size()), zz = normal_quantile * normal_quantile;
  double done = 0.0;
  for (const assembly::TaskScore& s : scores) done += s.complete() ? 1.0 : 0.0;
  const double p = done / n;
  const double centre = (p + zz / (2.0 * n)) / (1.0 + zz / n);
  const double half = normal_quantile * std::sqrt(p * (1.0 - p) / n + zz / (4.0 * n * n)) / (1.0 + zz / n);
  return text("%.0f %% (%.0f … %.0f)", 100.0 * p, 100.0 * (centre - half), 100.0 * (centre + half));
}

}  // namespace

std::string markdown_table(const std::vector<ToolTrials>& tools) {
  std::string table =
      "| tool | trials | completed | placed | time [s] | hand's way [m] | objects' way [m] | grasps | collisions | "
      "drops "
      "| largest force [N] | placement error [mm] |\n"
      "| --- | --- | --- | --- | --- | --- | --- | --- | --- | --- | --- | --- |\n";
  for (const ToolTrials& tool : tools) {
    const std::vector<assembly::TaskScore>& s = tool.scores;
    table += "| `" + tool.label + "` | " + std::to_string(s.size()) + " | " + completed(s);
    table += " | " + mean(s, 1.0, [](const assembly::TaskScore& t) { return t.placed; });
    table += " | " + mean(s, 1.0, [](const assembly::TaskScore& t) { return t.time; });
    table += " | " + mean(s, 1.0, [](const assembly::TaskScore& t) { return t.hand_path; });
    table += " | " + mean(s, 1.0, [](const assembly::TaskScore& t) { return t.object_path; });
    table += " | " + mean(s, 1.0, [](const assembly::TaskScore& t) { return t.grasps; });
    table += " | " + mean(s, 1.0, [](const assembly::TaskScore& t) { return t.collisions; });
    table += " | " + mean(s, 1.0, [](const assembly::TaskScore& t) { return t.drops; });
    table += " | " + mean(s, 1.0, [](const assembly::TaskScore& t) { return t.largest_force; });
    table += " | " + mean(s, 1e3, [](const assembly::TaskScore& t) { return t.position_error; }) + " |\n";
  }
  return table;
}

}  // namespace spring_workbench::assembly_trials
