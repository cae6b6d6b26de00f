#include "benchmark/stability_table.h"

#include <cmath>
#include <sstream>

namespace spring_workbench::benchmark {

StabilityCount count_stable(const Method& method, SceneKind kind) {
  StabilityCount count;
  count.method = method.name();
  count.scene = kind == SceneKind::stretch ? "A" : "C";
  for (int decade = 0; decade <= 10; ++decade) {
    for (const double mass : {1e-6, 1e-3, 1.0, 1e3, 1e6}) {
      Scenario scene = kind == SceneKind::stretch ? stretch_scene(std::pow(10.0, decade), 1.0, mass)
                                                  : six_dof_scene(std::pow(10.0, decade - 2), 1.0, mass);
      scene.duration = 1.0;
      for (const int steps : {1, 2, 5, 20}) {
        const RunResult result = run_isolated(method, scene, scene.output_interval / steps, {}, 10.0);
        const bool stable = result.finite;
        count.stable += stable;
        count.with_fallback += result.steps_fallback > 0;
        count.stable_at_50_hz += stable && steps == 1;
        count.total_at_50_hz += steps == 1;
        ++count.total;
      }
    }
  }
  return count;
}

bool has_stability_counts(const Method& method) { return method.knob() == Method::Knob::step; }

std::vector<StabilityCount> stability_table(const std::vector<const Method*>& methods, Units& units) {
  units.begin("stability counts");
  std::vector<StabilityCount> counts;
  std::size_t number = 0;
  for (const Method* method : methods) {
    if (!has_stability_counts(*method)) continue;
    for (const SceneKind kind : {SceneKind::stretch, SceneKind::six_dof}) {
      const std::string name =
          std::string("stability counts: ") + (kind == SceneKind::stretch ? "A " : "C ") + method->name();
      const auto rows =
          units.rows<StabilityCount>(number++, name, [&] { return std::vector{count_stable(*method, kind)}; });
      counts.insert(counts.end(), rows.begin(), rows.end());
    }
  }
  return counts;
}

std::string stability_counts_csv(const std::vector<StabilityCount>& counts) {
  std::ostringstream out;
  out << "method,scene,stable,total,stable_at_50_hz,total_at_50_hz,with_fallback\n";
  for (const StabilityCount& count : counts) {
    out << count.method << ',' << count.scene << ',' << count.stable << ',' << count.total << ','
        << count.stable_at_50_hz << ',' << count.total_at_50_hz << ',' << count.with_fallback << '\n';
  }
  return out.str();
}

}  // namespace spring_workbench::benchmark
