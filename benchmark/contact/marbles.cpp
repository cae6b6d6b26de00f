#include "benchmark/contact/marbles.h"

#include <cmath>

#include "benchmark/contact/bodies.h"

namespace spring_workbench::benchmark {
namespace {

constexpr double radius = 0.005, marble_mass = 1.3e-3;            // m, kg: glass
constexpr double tray_mass = 0.5;                                 // kg
constexpr double wall = 0.005, wall_height = 0.06;                // m
constexpr double above_bench = 0.3;                               // m
constexpr double max_tilt = 20.0 * M_PI / 180.0;                  // rad
constexpr double tilt_time = 4.0, rest_time = 1.0, period = 2.0;  // s

/// The inner width of a tray that holds this many marbles in two layers, with some space.
double inner_width(int marbles) { return 2.2 * radius * std::ceil(std::sqrt(0.5 * marbles)); }

/// The tray; its origin is the centre of the floor's upper face.
scene::Body tray(double inner) {
  const double outer = inner + 2.0 * wall;
  const Vector3d floor(outer, outer, wall);
  scene::Body body = box("held", floor, tray_mass, {0.0, 0.0, above_bench}, 0.3);
  body.collision[0].X_OS = at({0.0, 0.0, -0.5 * wall});
  for (const double side : {-1.0, 1.0}) {
    const double middle = side * 0.5 * (inner + wall), up = 0.5 * wall_height;
    body.collision.push_back({geometry::Box{{wall, outer, wall_height}}, at({middle, 0.0, up})});
    body.collision.push_back({geometry::Box{{inner, wall, wall_height}}, at({0.0, middle, up})});
  }
  return body;
}

}  // namespace

ContactTrial tilted_marbles(int marbles, double duration) {
  const double inner = inner_width(marbles);
  const int side = static_cast<int>(std::floor(inner / (2.05 * radius)));
  std::vector<scene::Body> bodies{tray(inner)};
  for (int i = 0; i < marbles; ++i) {
    const int layer = i / (side * side), row = i / side % side, column = i % side;
    const double shifted = 0.1 * radius * (layer % 2);  // otherwise one would stand exactly on top of another
    const Vector3d p(2.05 * radius * (column - 0.5 * (side - 1)) + shifted,
                     2.05 * radius * (row - 0.5 * (side - 1)) - shifted, above_bench + radius * (1.01 + 2.05 * layer));
    bodies.push_back(movable("marble" + std::to_string(i), geometry::Sphere{radius}, at(p), 0.3, marble_mass,
                             Vector3d::Constant(0.4 * marble_mass * radius * radius)));
  }
  ContactTrial trial;
  trial.trial = "marbles";
  trial.name = std::to_string(marbles) + " marbles";
  trial.scene = scene_with("marbles", scene::ContactMode::dynamic, std::move(bodies));
  trial.settings = settings_with(2e4, 200.0, 0.02, "held");
  const double length = trial.settings.fork.length;
  trial.X_WH = [length](double t) {
    const double turned = t < tilt_time ? max_tilt * std::sin(2.0 * M_PI * t / period) : 0.0;
    RigidTransform X_WE = at({0.0, 0.0, above_bench});
    X_WE.linear() = Eigen::AngleAxisd(turned, Vector3d(1.0, 0.3, 0.0).normalized()).toRotationMatrix();
    return RigidTransform(X_WE * hand_above(Vector3d::Zero(), length));
  };
  trial.rests_from = tilt_time;
  trial.duration = duration;
  return trial;
}

void run_marbles(bool quick, const TakeRow& take) {
  for (const int marbles : quick ? std::vector<int>{27} : std::vector<int>{100, 1000}) {
    TrialRun run(tilted_marbles(marbles, quick ? 0.4 : tilt_time + rest_time));
    while (run.advance()) continue;
    const RigidTransform X_TW = run.pose("held").inverse();
    int lost = 0;
    for (const bodies::BodyState& o : run.simulation().objects()) {
      if (o.name == "held") continue;
      const Vector3d p = X_TW * o.X_WO.translation();
      lost += p.z() < 0.0 || p.head<2>().cwiseAbs().maxCoeff() > 0.5 * inner_width(marbles) ? 1 : 0;
    }
    const Measured m = run.measured();
    take(run.row({at_most("lost", lost, 0.0), depth_bar(m), blocked_bar(m), unsolved_bar(m), rejected_bar(m),
                  at_most("mean", 1e3 * m.cpu_mean, 20.0, "ms"), at_most("99 %", 1e3 * m.cpu_99, 40.0, "ms"),
                  at_most("gained", 1e6 * m.gained_height, 3.0, "µm")}));
  }
}

}  // namespace spring_workbench::benchmark
