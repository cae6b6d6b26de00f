#include "benchmark/stability_table.h"

#include <cmath>
#include <ostream>

namespace spring_workbench::benchmark {

StabilityCount count_stable(const Method& method, SceneKind kind) {
  StabilityCount count;
  for (int decade = 0; decade <= 10; ++decade) {
    for (const double mass : {1e-6, 1e-3, 1.0, 1e3, 1e6}) {
      const Scenario scene = kind == SceneKind::stretch ? stretch_scene(std::pow(10.0, decade), 1.0, mass)
                                                        : six_dof_scene(std::pow(10.0, decade - 2), 1.0, mass);
      for (const int steps : {1, 2, 5, 20}) {
        const bool stable = run_isolated(method, scene, scene.output_interval / steps, 1, 10.0).finite;
        count.stable += stable;
        count.stable_at_50_hz += stable && steps == 1;
        count.total_at_50_hz += steps == 1;
        ++count.total;
      }
    }
  }
  return count;
}

void write_stability_table(const std::vector<const Method*>& methods, std::ostream& out, std::ostream& progress) {
  out << "method,scene,stable,total,stable_at_50_hz,total_at_50_hz\n";
  for (const Method* method : methods) {
    if (method->knob() != Method::Knob::step) continue;
    for (const SceneKind kind : {SceneKind::stretch, SceneKind::six_dof}) {
      progress << method->name() << (kind == SceneKind::stretch ? " A" : " C") << std::endl;
      const StabilityCount count = count_stable(*method, kind);
      out << method->name() << ',' << (kind == SceneKind::stretch ? 'A' : 'C') << ',' << count.stable << ','
          << count.total << ',' << count.stable_at_50_hz << ',' << count.total_at_50_hz << '\n';
    }
  }
}

}  // namespace spring_workbench::benchmark
