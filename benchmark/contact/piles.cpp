#include "benchmark/contact/piles.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>

#include "benchmark/contact/bodies.h"

namespace spring_workbench::benchmark {
namespace {

constexpr double edge = 0.04, gap = 1e-4, way = 0.05;  // m
constexpr double push_time = 1.0, rest_time = 0.4;     // s
constexpr double width = 0.1, height = 0.05;           // m, of a box in the stack
constexpr int stacked = 10;

std::string text(const char* before, double number, const char* after) {
  std::ostringstream out;
  out << before << number << after;
  return out.str();
}

/// Largest displacements over all bodies, along the bench and downwards.
struct Moved {
  double across = 0.0, down = 0.0;
};
Moved moved(const TrialRun& run, const std::string& except = "") {
  Moved most;
  for (std::size_t i = 0; i < run.start().size(); ++i) {
    const bodies::BodyState& now = run.simulation().objects()[i];
    if (now.name == except) continue;
    const Vector3d d = now.X_WO.translation() - run.start()[i].X_WO.translation();
    most.across = std::max(most.across, d.head<2>().norm());
    most.down = std::max(most.down, -d.z());
  }
  return most;
}

/// Where the bodies end, however long the run takes.
std::vector<RigidTransform> end_of(ContactTrial trial) {
  trial.max_seconds = std::numeric_limits<double>::infinity();
  TrialRun run(trial);
  while (run.advance()) continue;
  return run.poses();
}

Vector3d place_in_stack(int i) { return Vector3d(0.0, 0.0, (i + 0.5) * height); }

std::vector<scene::Body> stack_of(int boxes) {
  std::vector<scene::Body> bodies;
  for (int i = 0; i < boxes; ++i) {
    bodies.push_back(box("box" + std::to_string(i), {width, width, height}, 1.0, place_in_stack(i)));
  }
  return bodies;
}

}  // namespace

ContactTrial pushed_pile(int across, int high, double step) {
  std::vector<scene::Body> bodies;
  const double pitch = edge + gap, width_of_bar = across * pitch;
  const Vector3d p_bar(-0.5 * edge - gap, 0.5 * (width_of_bar - pitch), 0.5 * edge + 1e-3);
  bodies.push_back(box("held", {edge, width_of_bar, edge}, 0.5, p_bar));
  for (int k = 0; k < high; ++k) {
    for (int j = 0; j < across; ++j) {
      for (int i = 0; i < across; ++i) {
        const std::string name = "box" + std::to_string(i) + std::to_string(j) + std::to_string(k);
        bodies.push_back(
            box(name, Vector3d::Constant(edge), 0.1, Vector3d(0.5 * edge + pitch * i, pitch * j, (k + 0.5) * edge)));
      }
    }
  }
  ContactTrial trial;
  trial.trial = "pile";
  trial.name = std::to_string(across) + "x" + std::to_string(across) + "x" + std::to_string(high);
  trial.scene = scene_with("pile", scene::ContactMode::dynamic, std::move(bodies));
  trial.settings = settings_with(2e4, 100.0, step, "held");
  const double length = trial.settings.fork.length;
  trial.X_WH = [=](double t) {
    return hand_above(p_bar + minimum_jerk(t / push_time) * way * Vector3d::UnitX(), length);
  };
  trial.rests_from = push_time;
  trial.duration = push_time + rest_time;
  return trial;
}

void run_piles(bool quick, const TakeRow& take) {
  struct Size {
    int across, high;
    double mean,
        worst;  // s, bounds of the processor time per 20 ms; `worst` for all steps below 100 boxes, otherwise for 99 %
  };
  std::vector<Size> sizes{{2, 2, 1e-3, 5e-3}, {3, 3, 4e-3, 20e-3}, {5, 4, 10e-3, 20e-3}};
  if (quick) sizes.resize(1);
  for (const Size& size : sizes) {
    const ContactTrial trial = pushed_pile(size.across, size.high, 0.02);
    TrialRun run(trial);
    while (run.advance()) continue;
    const std::vector<RigidTransform> ends = run.poses(), finer = end_of(pushed_pile(size.across, size.high, 0.002));
    double off = 0.0;
    for (std::size_t i = 0; i < ends.size(); ++i) {
      off = std::max(off, (ends[i].translation() - finer[i].translation()).norm() / way);
    }
    const Measured m = run.measured();
    const bool many = size.across == 5;
    take(run.row({depth_bar(m), blocked_bar(m), unsolved_bar(m), rejected_bar(m),
                  at_most("mean", 1e3 * m.cpu_mean, 1e3 * size.mean, "ms"),
                  at_most(many ? "99 %" : "most", 1e3 * (many ? m.cpu_99 : m.cpu_most), 1e3 * size.worst, "ms"),
                  at_most("off a run with a tenth of the step", 100.0 * off, 1.0, "% of the way")}));
  }
}

ContactTrial standing_stack(double ratio, double duration) {
  ContactTrial trial;
  trial.trial = "stack";
  trial.name = text("top ", ratio, " times as heavy");
  trial.scene = scene_with("stack", scene::ContactMode::dynamic, stack_of(stacked));
  scene::MassProperties& top = trial.scene.bodies.back().mass_properties;
  top.mass *= ratio;
  top.inertia_O *= ratio;
  trial.settings = settings_with(0.0, 0.0, 0.02, "");
  trial.settings.fork.shape = rod::ShapeKind::bushing;
  const double length = trial.settings.fork.length;
  trial.X_WH = [length](double) { return hand_above(place_in_stack(stacked - 1), length); };
  trial.woken_until = duration;
  trial.rests_from = 0.0;
  trial.duration = duration;
  return trial;
}

ContactTrial pressed_stack(double stiffness, double step) {
  constexpr double press_time = 0.2, pressed = 0.01, above = 0.002;  // s, m
  ContactTrial trial;
  trial.trial = "stack";
  trial.name = text("pressed by a fork of ", stiffness, " N/m");
  const Vector3d p_top = place_in_stack(stacked - 1) + Vector3d(0.0, 0.0, above);
  std::vector<scene::Body> bodies = stack_of(stacked - 1);
  bodies.push_back(box("held", {width, width, height}, 1.0, p_top));
  trial.scene = scene_with("stack", scene::ContactMode::dynamic, std::move(bodies));
  trial.settings = settings_with(stiffness, 0.01 * stiffness, step, "held");
  const double length = trial.settings.fork.length;
  trial.X_WH = [=](double t) {
    return hand_above(p_top - (above + pressed) * minimum_jerk(t / press_time) * Vector3d::UnitZ(), length);
  };
  trial.rests_from = press_time;
  trial.duration = 1.0;
  return trial;
}

void run_stacks(bool quick, const TakeRow& take) {
  const auto judge = [&](const ContactTrial& trial) {
    TrialRun run(trial);
    Moved most;
    for (bool more = true; more;) {
      more = run.advance();
      const Moved now = moved(run, "held");
      most = {std::max(most.across, now.across), std::max(most.down, now.down)};
    }
    const Measured m = run.measured();
    take(run.row({at_most("drift", 1e3 * most.across, 0.1, "mm"), at_most("sink", 1e6 * most.down, 10.0, "µm"),
                  depth_bar(m), blocked_bar(m), unsolved_bar(m), rejected_bar(m),
                  at_most("mean", 1e3 * m.cpu_mean, 2.0, "ms"), at_most("gained", 1e6 * m.gained_height, 3.0, "µm")}));
  };
  for (const double ratio : {1.0, 1e3, 1e6}) judge(standing_stack(ratio, quick ? 1.0 : 60.0));
  const std::vector<double> steps = quick ? std::vector<double>{0.02} : std::vector<double>{0.001, 0.005, 0.02, 0.05};
  for (int decade = 0; decade <= 9; decade += quick ? 9 : 1) {
    for (const double step : steps) judge(pressed_stack(std::pow(10.0, decade), step));
  }
}

}  // namespace spring_workbench::benchmark
