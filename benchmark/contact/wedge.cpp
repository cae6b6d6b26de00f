#include "benchmark/contact/wedge.h"

#include <algorithm>
#include <cmath>
#include <sstream>

#include "benchmark/contact/bodies.h"

namespace spring_workbench::benchmark {
namespace {

constexpr double gravity = 9.81, slope = 5.0 * M_PI / 180.0;           // m/s², rad of each face
constexpr double bench_friction = 0.5;                                 // of the blocks on it
constexpr double heavy = 1000.0, light = 1.0, wedge_mass = 0.1;        // kg
constexpr double side = 0.2, high = 0.1;                               // m, of a block's middle section, of both blocks
constexpr double wedge_width = 0.04, wedge_high = 0.08, above = 0.06;  // m, at its middle; height of its middle
constexpr double clear = 1e-6;                                         // m
constexpr double speed = 0.01, ramp_time = 0.3, drive_time = 1.5;      // m/s, s
constexpr double drive_stiffness = 1e6;                                // N/m
constexpr double pressed = 100.0, press_stiffness = 1e4;               // N, N/m

/// A prism along y over a quadrilateral in x and z, symmetric about z = 0, whose left and right side run out by
/// `left` and `right` from the lower to the upper edge.
geometry::MeshPtr trapezoid(double width, double height, double left, double right) {
  auto mesh = std::make_shared<geometry::TriangleMesh>();
  for (const double y : {-0.5 * side, 0.5 * side}) {
    mesh->vertices.emplace_back(-0.5 * width + 0.5 * left, y, -0.5 * height);
    mesh->vertices.emplace_back(0.5 * width - 0.5 * right, y, -0.5 * height);
    mesh->vertices.emplace_back(0.5 * width + 0.5 * right, y, 0.5 * height);
    mesh->vertices.emplace_back(-0.5 * width - 0.5 * left, y, 0.5 * height);
  }
  const auto quad = [&](int a, int b, int c, int d) {
    mesh->triangles.emplace_back(a, b, c);
    mesh->triangles.emplace_back(a, c, d);
  };
  quad(0, 1, 2, 3);
  quad(7, 6, 5, 4);
  for (int i = 0; i < 4; ++i) quad(i, i + 4, (i + 1) % 4 + 4, (i + 1) % 4);
  return mesh;
}

/// A part with its centre of mass at its origin.
scene::Body part(const std::string& name, const geometry::MeshPtr& mesh, const Vector3d& middle, double friction,
                 double mass) {
  const geometry::VolumeProperties of = geometry::volume_properties(geometry::Geometry(mesh));
  scene::Body body = uniform(name, mesh, at(middle + of.centre), friction, mass);
  body.collision[0].X_OS = at(-of.centre);
  return body;
}

/// Wall, light block, wedge and heavy block from left to right. A pair's friction is the geometric mean.
std::vector<scene::Body> parts(double friction) {
  const double block_run = high * std::tan(slope), wedge_run = wedge_high * std::tan(slope);
  // At the height of the wedge's centre, the distance between the faces of the blocks is the width of the wedge.
  const double gap_at_middle = 0.5 * wedge_width + clear;
  const double to_middle = (above - 0.5 * high) * std::tan(slope);  // further out than at the centre of the block
  const double x_block = gap_at_middle - to_middle + 0.5 * side;
  const scene::Body wall =
      standing("wall", geometry::Box{{0.1, 1.0, 1.0}}, at({-x_block - 0.5 * side - 0.05 - clear, 0.0, 0.5}), 0.0);
  return {part("wedge", trapezoid(wedge_width, wedge_high, wedge_run, wedge_run), {0.0, 0.0, above},
               friction * friction / bench_friction, wedge_mass),
          part("light", trapezoid(side, high, 0.0, -block_run), {-x_block, 0.0, 0.5 * high}, bench_friction, light),
          part("heavy", trapezoid(side, high, -block_run, 0.0), {x_block, 0.0, 0.5 * high}, bench_friction, heavy),
          wall};
}

std::string name_with(const char* what, double friction) {
  std::ostringstream out;
  out << what << ", friction " << friction;
  return out.str();
}

}  // namespace

ContactTrial driven_wedge(double friction) {
  ContactTrial trial;
  trial.trial = "wedge";
  trial.name = name_with("driven", friction);
  trial.scene = scene_with("wedge", scene::ContactMode::dynamic, parts(friction), bench_friction);
  trial.settings = settings_with(drive_stiffness, 1e4, 0.02, "wedge");
  const Vector3d p = trial.scene.bodies[0].X_WO.translation();
  const double length = trial.settings.fork.length;
  trial.X_WH = [=](double t) {
    const double u = std::min(t, drive_time);
    const double down = speed * (u < ramp_time ? 0.5 * u * u / ramp_time : u - 0.5 * ramp_time);
    return hand_above(p + down * Vector3d(std::tan(slope), 0.0, -1.0), length);  // along the light block's face
  };
  trial.duration = drive_time;
  return trial;
}

ContactTrial squeezed_wedge(double friction) {
  ContactTrial trial;
  trial.trial = "wedge";
  trial.name = name_with("squeezed", friction);
  std::vector<scene::Body> bodies = parts(friction);
  bodies.pop_back();  // the hand replaces the wall
  trial.scene = scene_with("wedge", scene::ContactMode::dynamic, std::move(bodies), bench_friction);
  trial.settings = settings_with(press_stiffness, 1e3, 0.02, "light");
  const Vector3d p(trial.scene.bodies[1].X_WO.translation().x(), 0.0, above);  // at the height of the pressing force
  const double length = trial.settings.fork.length;
  trial.X_WH = [=](double t) {
    return hand_above(p + minimum_jerk(t / 0.3) * pressed / press_stiffness * Vector3d::UnitX(), length);
  };
  trial.rests_from = 0.3;
  trial.duration = 1.0;
  return trial;
}

void run_wedges(bool quick, const TakeRow& take) {
  for (const double friction : {0.05, 0.3}) {
    TrialRun run(driven_wedge(friction));
    // Steady state: the faces of the blocks transmit H at the angle of slope plus friction; the heavy block slides.
    const double steep = std::tan(slope + std::atan(friction));
    const double H = bench_friction * heavy * gravity / (1.0 - bench_friction * steep);
    double off = 0.0;
    while (run.advance()) {
      if (run.time() < drive_time - 0.4) continue;
      const Vector3d f = run.simulation().tool().tip_wrench_W.force;
      const double down = -f.z() + wedge_mass * gravity, exact = (2.0 * H - f.x()) * steep;
      off = std::max(off, std::abs(down / exact - 1.0));
    }
    const double went = -(run.pose("wedge").translation() - run.start()[0].X_WO.translation()).z();
    const Measured m = run.measured();
    take(run.row(
        {at_most("force off the exact one", 100.0 * off, 1.0, "%"),
         at_least("goes in", 1e3 * went,
                  1e3 * (speed * (drive_time - 0.5 * ramp_time) - 2.0 * H * steep / drive_stiffness) - 1.0, "mm"),
         depth_bar(m), blocked_bar(m), unsolved_bar(m), rejected_bar(m)}));
  }
  for (const double friction : {0.05, 0.3}) {
    if (quick) continue;
    TrialRun run(squeezed_wedge(friction));
    double rose = 0.0;
    while (run.advance()) {
      rose = std::max(rose, (run.pose("wedge").translation() - run.start()[0].X_WO.translation()).z());
    }
    const bool locks = friction > std::tan(slope);
    const Measured m = run.measured();
    take(run.row({locks ? at_most("rises", 1e3 * rose, 0.1, "mm") : at_least("rises", 1e3 * rose, 5.0, "mm"),
                  depth_bar(m), blocked_bar(m), unsolved_bar(m), rejected_bar(m),
                  at_most("gained", 1e6 * m.gained_height, 3.0, "µm")}));
  }
}

}  // namespace spring_workbench::benchmark
