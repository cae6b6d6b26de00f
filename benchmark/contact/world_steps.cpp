#include "benchmark/contact/world_steps.h"

#include <algorithm>
#include <cmath>
#include <functional>

#include "benchmark/contact/processor_time.h"
#include "spring_workbench/contact/contact_engines.h"
#include "spring_workbench/simulation/simulation.h"
#include "spring_workbench/validation/input_error.h"

namespace spring_workbench::benchmark {
namespace {

constexpr double g = 9.81, mu = 0.4, restitution = 0.7, radius = 0.05;  // m/s², –, –, m
constexpr double speed = 1.5, drop = 0.5;                               // m/s, m

scene::Body body_of(const std::string& name, const geometry::Geometry& geometry, double mass, const Vector3d& inertia,
                    const Vector3d& p_WO) {
  scene::Body body;
  body.name = name;
  body.movable = true;
  body.X_WO.translation() = p_WO;
  body.mass_properties.mass = mass;
  body.mass_properties.inertia_O = inertia.asDiagonal();
  body.material.friction = mu;
  body.collision.push_back({geometry});
  return body;
}

scene::Body ball(double height) {
  scene::Body body =
      body_of("ball", geometry::Sphere{radius}, 1.0, Vector3d::Constant(0.4 * radius * radius), Vector3d(0, 0, height));
  return body;
}

scene::Body box(const std::string& name, double edge, const Vector3d& p_WO) {
  return body_of(name, geometry::Box{Vector3d::Constant(edge)}, 1.0, Vector3d::Constant(edge * edge / 6.0), p_WO);
}

scene::Scene scene_of(std::vector<scene::Body> bodies, double bounce = 0.0) {
  scene::Scene scene;
  scene.name = scene.path = "steps";
  scene.contact = scene::ContactMode::dynamic;
  scene.bench_material.friction = mu;
  scene.bench_material.restitution = bounce;
  scene.bodies = std::move(bodies);
  for (scene::Body& body : scene.bodies) body.material.restitution = bounce;
  return scene;
}

/// A scene simulated in the rigid-body world alone.
struct Alone {
  std::string name;
  scene::Scene scene;
  Vector3d v;                                 ///< at the start [m/s]
  double duration;                            ///< [s]
  std::function<Vector3d(double t)> p_exact;  ///< exact position of the centre [m]
};

std::vector<Alone> scenes_alone() {
  const auto along = [](double height, double x) { return Vector3d(x, 0.0, height); };
  const auto slides = [along](double t) {
    const double stop = speed / (mu * g), u = std::min(t, stop);
    return along(0.05, speed * u - 0.5 * mu * g * u * u);
  };
  const auto rolls = [along](double t) {
    const double grip = 2.0 * speed / (7.0 * mu * g), u = std::min(t, grip);
    return along(radius, speed * u - 0.5 * mu * g * u * u + 5.0 / 7.0 * speed * std::max(0.0, t - grip));
  };
  const auto bounces = [along](double t) {
    double left = t - std::sqrt(2.0 * drop / g), v = restitution * std::sqrt(2.0 * g * drop);
    if (left < 0.0) return along(radius + drop - 0.5 * g * t * t, 0.0);
    for (; left > 2.0 * v / g; v *= restitution) left -= 2.0 * v / g;
    return along(radius + v * left - 0.5 * g * left * left, 0.0);
  };
  return {
      {"box slides and stops", scene_of({box("box", 0.1, Vector3d(0, 0, 0.05))}), Vector3d(speed, 0, 0), 0.6, slides},
      {"sphere slips, then rolls", scene_of({ball(radius)}), Vector3d(speed, 0, 0), 0.6, rolls},
      {"sphere bounces", scene_of({ball(radius + drop)}, restitution), Vector3d::Zero(), 1.2, bounces}};
}

WorldStepRow run_alone(const Alone& s, double step) {
  WorldStepRow row{s.name, "exact", step};
  const std::unique_ptr<rigid_bodies::RigidWorld> world = contact::open_rigid_world(s.scene);
  Twist start;
  start.linear = s.v;
  const RigidTransform X0 = world->pose(0);
  world->place(0, X0, start, true);
  std::vector<rigid_bodies::DrivenBody> none;
  double spent = 0.0, displacement = 0.0;
  const int steps = static_cast<int>(std::lround(s.duration / step));
  for (int i = 1; i <= steps; ++i) {
    const double begin = processor_time();
    world->step(step, none);
    spent += processor_time() - begin;
    const Vector3d exact = s.p_exact(i * step);
    row.error = std::max(row.error, (world->pose(0).translation() - exact).norm());
    displacement = std::max(displacement, (exact - X0.translation()).norm());
  }
  row.error_share = row.error / displacement;
  row.cpu_us_per_simulated_second = 1e6 * spent / s.duration;
  return row;
}

/// Poses every 20 ms of a box that is held and pushes another along the bench.
struct Push {
  std::vector<Vector3d> p;
  double seconds = 0.0;
};

constexpr double push_duration = 1.0, sample_time = 0.02;  // s

Push push(double step) {
  const double edge = 0.1;
  simulation::SimulationSettings set;
  set.grasp.object = "pusher";
  set.dynamics.step = step;
  simulation::Simulation simulation(
      scene_of({box("pusher", edge, Vector3d(0, 0, 0.06)), box("pushed", edge, Vector3d(0.15, 0, 0.05))}), set);
  const int samples = static_cast<int>(std::lround(push_duration / sample_time));
  Push run;
  for (int i = 0; i <= samples; ++i) {
    const double t = i * sample_time, u = std::min(1.0, t / 0.8);
    const Vector3d p(0.2 * u * u * (3.0 - 2.0 * u), 0.0, 0.06 + set.fork.length);
    simulation.push_stylus({t, make_transform(Quaterniond(0.0, 1.0, 0.0, 0.0), p)});
  }
  for (int i = 1; i <= samples; ++i) {
    const double begin = processor_time();
    simulation.advance(i * sample_time);
    run.seconds += processor_time() - begin;
    for (const bodies::BodyState& object : simulation.objects()) run.p.push_back(object.X_WO.translation());
  }
  return run;
}

void add_pushes(const std::vector<double>& steps, double converged_step, std::vector<WorldStepRow>& rows) {
  const Push converged = push(converged_step);
  const double displacement = (converged.p.back() - converged.p[1]).norm();
  for (const double step : steps) {
    const Push run = push(step);
    WorldStepRow row{"held box pushes another", "converged", step};
    for (std::size_t i = 0; i < run.p.size(); ++i) row.error = std::max(row.error, (run.p[i] - converged.p[i]).norm());
    row.error_share = row.error / displacement;
    row.cpu_us_per_simulated_second = 1e6 * run.seconds / push_duration;
    rows.push_back(row);
  }
}

}  // namespace

bool has_dynamic_contact() {
  try {
    contact::open_rigid_world(scene_of({}));
    return true;
  } catch (const validation::InputError&) {
    return false;
  }
}

std::vector<WorldStepRow> measure_world_steps(bool quick) {
  std::vector<WorldStepRow> rows;
  if (!has_dynamic_contact()) return rows;
  const std::vector<double> alone = quick ? std::vector<double>{1e-2, 2e-3, 5e-4}
                                          : std::vector<double>{2e-2, 1e-2, 5e-3, 2e-3, 1e-3, 5e-4, 2e-4, 1e-4};
  for (const Alone& scene : scenes_alone()) {
    for (const double step : alone) rows.push_back(run_alone(scene, step));
  }
  add_pushes(
      quick ? std::vector<double>{2e-2, 2e-3, 1e-3} : std::vector<double>{2e-2, 1e-2, 5e-3, 2e-3, 1e-3, 5e-4, 2.5e-4},
      quick ? 2.5e-4 : 1e-4, rows);
  return rows;
}

}  // namespace spring_workbench::benchmark
