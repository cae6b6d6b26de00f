#include "benchmark/contact/scale.h"

#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <limits>
#include <stdexcept>
#include <string>

#include "benchmark/contact/processor_time.h"
#include "spring_workbench/simulation/simulation.h"

namespace spring_workbench::benchmark {
namespace {

constexpr double edge = 0.04, spacing = 0.1;  // m
constexpr double sample_time = 0.02;          // s
constexpr int steps_warm = 20, steps_a_window = 10, windows = 10;

double resident_bytes() {
  std::ifstream file("/proc/self/statm");
  double total = 0.0, resident = 0.0;
  file >> total >> resident;
  return resident * static_cast<double>(sysconf(_SC_PAGESIZE));
}

/// Boxes on the bench in a square grid; the first one is held.
scene::Scene grid(scene::ContactMode contact, int objects) {
  scene::Scene scene;
  scene.name = scene.path = "grid";
  scene.contact = contact;
  const int side = static_cast<int>(std::ceil(std::sqrt(objects)));
  for (int i = 0; i < objects; ++i) {
    scene::Body body;
    body.name = "box" + std::to_string(i);
    body.movable = true;
    body.X_WO.translation() = Vector3d(spacing * (i % side), spacing * (i / side), 0.5 * edge);
    body.mass_properties.mass = 0.1;
    body.mass_properties.inertia_O = 0.1 / 6.0 * edge * edge * Matrix3d::Identity();
    body.collision.push_back({geometry::Box{Vector3d::Constant(edge)}});
    scene.bodies.push_back(body);
  }
  return scene;
}

ScaleRow measure(scene::ContactMode contact, int objects) {
  ScaleRow row{contact, objects};
  const scene::Scene scene = grid(contact, objects);
  simulation::SimulationSettings settings;
  settings.grasp.object = "box0";
  const double before = resident_bytes(), begin = processor_time();
  simulation::Simulation simulation(scene, settings);
  row.start = processor_time() - begin;
  row.step = std::numeric_limits<double>::infinity();
  double used = 0.0;
  for (int i = 0; i < steps_warm + windows * steps_a_window; ++i) {
    const double t = sample_time * i, lifted = std::min(1.0, t / 0.2);
    const Vector3d p(0.1 * std::sin(3.0 * t), 0.1 * std::sin(4.0 * t),
                     0.5 * edge + 0.06 * lifted + settings.fork.length);
    simulation.push_stylus({t, make_transform(p, Quaterniond(0.0, 1.0, 0.0, 0.0))});
    const double step_begin = processor_time();
    simulation.advance_to(t);
    used += processor_time() - step_begin;
    if (i < steps_warm || (i - steps_warm) % steps_a_window != steps_a_window - 1) {
      if (i < steps_warm) used = 0.0;
      continue;
    }
    row.step = std::min(row.step, used / steps_a_window);
    used = 0.0;
  }
  row.memory = resident_bytes() - before;
  return row;
}

}  // namespace

ScaleRow measure_scale(scene::ContactMode contact, int objects) {
  int ends[2];
  if (pipe(ends) != 0) throw std::runtime_error("no pipe");
  const pid_t child = fork();
  if (child < 0) throw std::runtime_error("no process");
  if (child == 0) {
    const ScaleRow row = measure(contact, objects);
    const bool written = write(ends[1], &row, sizeof row) == static_cast<ssize_t>(sizeof row);
    _exit(written ? 0 : 1);
  }
  close(ends[1]);
  ScaleRow row;
  const bool got = read(ends[0], &row, sizeof row) == static_cast<ssize_t>(sizeof row);
  close(ends[0]);
  waitpid(child, nullptr, 0);
  if (!got) throw std::runtime_error("the measuring process ended early");
  return row;
}

}  // namespace spring_workbench::benchmark
