#include "benchmark/contact/motion_steps.h"

#include <algorithm>
#include <cmath>

#include "benchmark/contact/bodies.h"
#include "benchmark/contact/exact_motions.h"
#include "benchmark/contact/processor_time.h"
#include "spring_workbench/contact/contact_engines.h"
#include "spring_workbench/simulation/simulation.h"
#include "spring_workbench/validation/input_error.h"

namespace spring_workbench::benchmark {
namespace {

constexpr double mu = 0.4, push_duration = 1.0, sample_time = 0.02;  // –, s, s

scene::Scene pushing_scene() {
  const Vector3d size = Vector3d::Constant(0.1);
  return scene_with("push", scene::ContactMode::dynamic,
                    {box("pusher", size, 1.0, {0.0, 0.0, 0.06}, mu), box("pushed", size, 1.0, {0.15, 0.0, 0.05}, mu)},
                    mu);
}

/// Poses every 20 ms of a box that is held and pushes another along the bench.
struct Push {
  std::vector<Vector3d> p;
  double seconds = 0.0;
};

Push push(double step) {
  simulation::SimulationSettings set;
  set.grasp.object = "pusher";
  set.dynamics.step = step;
  simulation::Simulation simulation(pushing_scene(), set);
  const int samples = static_cast<int>(std::lround(push_duration / sample_time));
  Push run;
  for (int i = 0; i <= samples; ++i) {
    const double t = i * sample_time, u = std::min(1.0, t / 0.8);
    const Vector3d p(0.2 * u * u * (3.0 - 2.0 * u), 0.0, 0.06 + set.fork.length);
    simulation.push_stylus({t, make_transform(p, Quaterniond(0.0, 1.0, 0.0, 0.0))});
  }
  for (int i = 1; i <= samples; ++i) {
    const double begin = processor_time();
    simulation.advance_to(i * sample_time);
    run.seconds += processor_time() - begin;
    for (const bodies::BodyState& object : simulation.objects()) run.p.push_back(object.X_WO.translation());
  }
  return run;
}

void add_pushes(const std::vector<double>& steps, double converged_step, std::vector<MotionStepRow>& rows) {
  const Push converged = push(converged_step);
  const double displacement = (converged.p.back() - converged.p[1]).norm();
  for (const double step : steps) {
    const Push run = push(step);
    MotionStepRow row{"held box pushes another, dynamic", "converged", step};
    for (std::size_t i = 0; i < run.p.size(); ++i) row.error = std::max(row.error, (run.p[i] - converged.p[i]).norm());
    row.error_share = row.error / displacement;
    row.cpu_us_per_simulated_second = 1e6 * run.seconds / push_duration;
    rows.push_back(row);
  }
}

}  // namespace

bool has_dynamic_contact() {
  try {
    contact::open_rigid_world(pushing_scene());
    return true;
  } catch (const validation::InputError&) {
    return false;
  }
}

std::vector<MotionStepRow> measure_motion_steps(bool quick) {
  std::vector<MotionStepRow> rows;
  if (!has_dynamic_contact()) return rows;
  const std::vector<double> steps = quick ? std::vector<double>{1e-2, 2e-3, 5e-4}
                                          : std::vector<double>{2e-2, 1e-2, 5e-3, 2e-3, 1e-3, 5e-4, 2e-4, 1e-4};
  for (const scene::ContactMode contact : {scene::ContactMode::stop, scene::ContactMode::dynamic}) {
    for (const std::string& motion : motions_in_contact()) {
      for (const double step : steps) {
        const MotionRun run = run_motion(motion, contact, step);
        rows.push_back({motion + ", " + name_of(contact), "exact", step, run.error, run.error / run.displacement,
                        1e6 * run.processor_time / run.duration});
      }
    }
  }
  add_pushes(
      quick ? std::vector<double>{2e-2, 2e-3, 1e-3} : std::vector<double>{2e-2, 1e-2, 5e-3, 2e-3, 1e-3, 5e-4, 2.5e-4},
      quick ? 2.5e-4 : 1e-4, rows);
  return rows;
}

}  // namespace spring_workbench::benchmark
