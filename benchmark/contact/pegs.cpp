#include "benchmark/contact/pegs.h"

#include <algorithm>
#include <cmath>

#include "benchmark/contact/bodies.h"

namespace spring_workbench::benchmark {
namespace {

constexpr double width = 0.02, length = 0.06;             // m, of the peg
constexpr double clearance = 1e-4;                        // m
constexpr double depth_of_hole = 0.05, thickness = 0.02;  // m, of the block around it
constexpr double entered = 0.01, pushed = 0.035;          // m
constexpr double aside = 3e-3, turned = 2.0 * M_PI / 180.0;
constexpr double aside_time = 0.3, ramp_time = 0.1, push_time = 1.0, rest_time = 0.3;  // s
constexpr int facets = 48;

/// A tube around z whose inner facets leave half of the clearance to the peg.
geometry::MeshPtr tube() {
  const double inner = 0.5 * (width + clearance) / std::cos(M_PI / facets), outer = 0.5 * width + thickness;
  auto mesh = std::make_shared<geometry::TriangleMesh>();
  for (int i = 0; i < facets; ++i) {
    const double a = 2.0 * M_PI * i / facets;
    for (const double r : {inner, outer}) {
      for (const double z : {-0.5 * depth_of_hole, 0.5 * depth_of_hole}) {
        mesh->vertices.emplace_back(r * std::cos(a), r * std::sin(a), z);
      }
    }
  }
  // Corners of a section: 0 and 1 below and above inside, 2 and 3 outside.
  const auto quad = [&](int i, int a, int b) {
    const int here = 4 * i, next = 4 * ((i + 1) % facets);
    mesh->triangles.emplace_back(here + a, next + a, next + b);
    mesh->triangles.emplace_back(here + a, next + b, here + b);
  };
  for (int i = 0; i < facets; ++i) {
    quad(i, 1, 0);
    quad(i, 2, 3);
    quad(i, 3, 1);
    quad(i, 0, 2);
  }
  return mesh;
}

scene::Body block(bool round, bool movable) {
  const RigidTransform X_WO = at({0.0, 0.0, 0.5 * depth_of_hole});
  const double half = 0.5 * (width + clearance + thickness), across = width + clearance + 2.0 * thickness;
  scene::Body body = standing("block", geometry::Box{{thickness, across, depth_of_hole}}, X_WO, 0.3);
  if (round) {
    body.collision[0].geometry = tube();
  } else {
    body.collision[0].X_OS = at({half, 0.0, 0.0});
    body.collision.push_back({geometry::Box{{thickness, across, depth_of_hole}}, at({-half, 0.0, 0.0})});
    for (const double y : {-half, half}) {
      body.collision.push_back({geometry::Box{{width + clearance, thickness, depth_of_hole}}, at({0.0, y, 0.0})});
    }
  }
  if (!movable) return body;
  body.movable = true;
  body.mass_properties.mass = 5.0;
  body.mass_properties.inertia_O = box_inertia(5.0, {across, across, depth_of_hole}).asDiagonal();
  return body;
}

}  // namespace

ContactTrial peg_in_hole(bool round, scene::ContactMode contact) {
  const Vector3d p_peg(0.0, 0.0, depth_of_hole - entered + 0.5 * length);
  const geometry::Geometry shape = round ? geometry::Geometry(geometry::Cylinder{0.5 * width, length})
                                         : geometry::Geometry(geometry::Box{{width, width, length}});
  ContactTrial trial;
  trial.trial = "peg";
  trial.name = round ? "cylinder in a concave mesh" : "box among walls";
  const bool movable = contact == scene::ContactMode::dynamic;
  if (movable) trial.name += ", movable";
  trial.scene = scene_with("peg", contact, {uniform("held", shape, at(p_peg), 0.3, 0.1), block(round, movable)});
  trial.settings = settings_with(2000.0, 5.0, 0.02, "held");
  trial.settings.fork.stiffness.bend = 100.0;  // a stiffer fork jams the peg, as expected
  const double fork = trial.settings.fork.length;
  trial.X_WH = [=](double t) {
    const double off = minimum_jerk(t / aside_time);
    // Moves down at constant speed after a ramp.
    const double u = std::clamp(t - aside_time, 0.0, push_time);
    const double progress =
        (u < ramp_time ? 0.5 * u * u / ramp_time : u - 0.5 * ramp_time) / (push_time - 0.5 * ramp_time);
    RigidTransform X_WE = at(p_peg + Vector3d(off * aside, 0.0, -progress * pushed));
    X_WE.linear() = Eigen::AngleAxisd(off * turned, Vector3d::UnitY()).toRotationMatrix();
    return RigidTransform(X_WE * hand_above(Vector3d::Zero(), fork));
  };
  trial.rests_from = aside_time + push_time;
  trial.duration = trial.rests_from + rest_time;
  return trial;
}

void run_pegs(bool quick, const TakeRow& take) {
  for (const bool round : {false, true}) {
    for (const scene::ContactMode contact : {scene::ContactMode::stop, scene::ContactMode::dynamic}) {
      if (quick && (round || contact == scene::ContactMode::dynamic)) continue;
      TrialRun run(peg_in_hole(round, contact));
      std::vector<double> forces;  // upward force on the peg while the hand moves down steadily [N]
      while (run.advance()) {
        const double t = run.time() - aside_time;
        if (t > 0.3 * push_time && t < 0.95 * push_time) {
          forces.push_back(-run.simulation().tool().tip_wrench_W.force.z());
        }
      }
      double mean = 0.0, ripple = 0.0;
      for (const double f : forces) mean += f / static_cast<double>(forces.size());
      for (std::size_t i = 1; i + 1 < forces.size(); ++i) {
        ripple = std::max(ripple, std::abs(forces[i] - 0.5 * (forces[i - 1] + forces[i + 1])) / std::abs(mean));
      }
      const double block_top = run.poses()[1].translation().z() + 0.5 * depth_of_hole;
      const double in = block_top - (run.pose("held").translation().z() - 0.5 * length);
      const Measured m = run.measured();
      take(run.row({at_least("in", 1e3 * in, 1e3 * (entered + pushed) - 5.0, "mm"),
                    at_most("ripple", 100.0 * ripple, 1.0, "%"), at_most("depth", 1e6 * m.deepest.depth, 10.0, "µm"),
                    blocked_bar(m), unsolved_bar(m), rejected_bar(m),
                    at_most("gained", 1e6 * m.gained_height, 3.0, "µm")}));
    }
  }
}

}  // namespace spring_workbench::benchmark
