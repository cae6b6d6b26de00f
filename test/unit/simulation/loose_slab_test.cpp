// Released objects on a heavy slab that lies loose on an incline, in one world with it, against exact solutions.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "support/bench_scenes.h"

namespace spring_workbench::simulation::loose_slab_test {
namespace {

constexpr double g = 9.81, radius = 0.05, slab_height = 0.05, held_for = 0.04;

scene::Body ball(double friction, double restitution, const std::string& name = "body") {
  scene::Body b = box(name, Vector3d::Ones(), 1.0, Vector3d::Zero(), friction);
  b.mass_properties.inertia_O = 0.4 * radius * radius * Matrix3d::Identity();
  b.material.restitution = restitution;
  b.collision[0].geometry = geometry::Sphere{radius};
  return b;
}

/// The angle of the incline about y, so that x leads down the slope, and whether the slab is its first body.
struct Slope {
  double angle;
  bool slab_first;
};

class LooseSlab : public testing::TestWithParam<Slope> {
 protected:
  /// Axes of the slope at the middle of the slab's upper face.
  static RigidTransform top() {
    RigidTransform X_WS(Eigen::AngleAxisd(GetParam().angle, Vector3d::UnitY()));
    X_WS.translation() = Vector3d(0, 0, 2.0);
    return X_WS;
  }
  /// `bodies` are placed in the axes of the slope. All have the friction of the first; the slab sticks to the incline.
  static scene::Scene on_slab(std::vector<scene::Body> bodies) {
    const double friction = bodies[0].material.friction;
    scene::Body slab = box("slab", Vector3d(6.0, 2.0, slab_height), 1e4, Vector3d(0, 0, -0.5 * slab_height), friction);
    slab.material.restitution = bodies[0].material.restitution;
    const Vector3d below(0, 0, -slab_height - 0.1);
    bodies.insert(GetParam().slab_first ? bodies.begin() : bodies.end(), slab);
    bodies.push_back(box("incline", Vector3d(6.0, 2.0, 0.2), 0.0, below, 16.0 / friction));
    for (scene::Body& b : bodies) b.X_WO = top() * b.X_WO;
    return scene_of(std::move(bodies), scene::ContactMode::dynamic);
  }
  /// Carries "body" at `v`, in the axes of the slope, by a rigid fork, and lets it go where it is at `held_for`.
  static Simulation let_go(scene::Body body, const Vector3d& v, double step) {
    body.X_WO.translation() -= held_for * v;
    const RigidTransform X_WO = top() * body.X_WO;
    SimulationSettings set;
    set.fork.dofs = {false, false, false};
    set.dynamics.step = step;
    set.grasp.object = "body";
    Simulation s(on_slab({std::move(body)}), set);
    for (double t = 0.0; t < held_for + 0.04; t += 0.02) {
      RigidTransform X_WH = X_WO;
      X_WH.translation() += top().linear() * (t * v - set.fork.length * Vector3d::UnitZ());
      s.push_stylus({t, X_WH});
    }
    s.advance_to(held_for);
    s.release();
    return s;
  }
  /// Position in the axes of the slope.
  static Vector3d place(const Simulation& s, const std::string& name = "body") {
    return top().inverse() * object(s, name).X_WO.translation();
  }
};
INSTANTIATE_TEST_SUITE_P(Slopes, LooseSlab,
                         testing::Values(Slope{0.0, false}, Slope{0.0, true}, Slope{0.15, false}, Slope{0.15, true}));

TEST_P(LooseSlab, ABoxStopsAfterItsWayHoweverShortThatIs) {
  const double mu = 0.4, brakes = g * (mu * std::cos(GetParam().angle) - std::sin(GetParam().angle));
  for (const double step : {0.02, 5e-3}) {
    for (const double v : {0.05, 0.3, 1.5}) {
      const Vector3d start(-1.0, 0, 0.03);
      Simulation s = let_go(box("body", Vector3d(0.1, 0.08, 0.06), 1.0, start, mu), v * Vector3d::UnitX(), step);
      double told = 0.0;
      for (int i = 1; i <= 50; ++i) {
        told = std::max(told, s.advance_to(held_for + 0.02 * i).position_error);
        const double moving = std::min(0.02 * i, v / brakes);
        const Vector3d exact = start + (v * moving - 0.5 * brakes * moving * moving) * Vector3d::UnitX();
        EXPECT_LT((place(s) - exact).norm(), 1e-5) << step << ' ' << v << ' ' << i;
      }
      EXPECT_GT(told, 1e-9) << step << ' ' << v;  // when it stops
      EXPECT_LE(told, 2e-6) << step << ' ' << v;
    }
  }
}

TEST_P(LooseSlab, ASphereSlipsAndThenRolls) {
  const double mu = 0.3, along = g * std::sin(GetParam().angle), across = g * std::cos(GetParam().angle), v = 1.2;
  const double grip = v / (3.5 * mu * across - along), slips = along - mu * across, rolls = 5.0 / 7.0 * along;
  for (const double step : {0.02, 5e-3}) {
    scene::Body body = ball(mu, 0.0);
    const Vector3d start(-2.0, 0, radius);
    body.X_WO.translation() = start;
    Simulation s = let_go(body, v * Vector3d::UnitX(), step);
    for (int i = 1; i <= 50; ++i) {
      s.advance_to(held_for + 0.02 * i);
      const double first = std::min(0.02 * i, grip), then = 0.02 * i - first;
      const double way =
          v * first + 0.5 * slips * first * first + (v + slips * first) * then + 0.5 * rolls * then * then;
      EXPECT_LT((place(s) - start - way * Vector3d::UnitX()).norm(), 1e-5) << step << ' ' << i;
    }
  }
}

/// The exact height of a ball after a fall from `drop` at rest, 0 once it comes down slower than `slowest`; and how far
/// it may be off if each bounce, and then the next fall, is `early` [s] off.
struct Bouncing {
  double height = 0.0, off = 1e-6;
};
Bouncing bouncing(double drop, double restitution, double gravity, double slowest, double t) {
  constexpr double early = 2e-5;
  Bouncing exact;
  double v = std::sqrt(2.0 * gravity * drop), left = t - v / gravity;
  if (left < 0.0) return {drop - 0.5 * gravity * t * t, exact.off};
  for (;; left -= 2.0 * v / gravity) {
    if (v < slowest) return exact;
    exact.off += early * (1.0 + restitution) * v;
    v *= restitution;
    if (left <= 2.0 * v / gravity) break;
  }
  exact.height = v * left - 0.5 * gravity * left * left;
  return exact;
}

// From a millimetre it bounces several times within a step; one that touches stops none that bounces later. Each time
// it may bounce 10 µs early.
TEST_P(LooseSlab, EachBallBouncesInItsOwnTime) {
  const double across = g * std::cos(GetParam().angle), slowest = 0.05;
  for (const double e : {0.5, 0.9}) {
    const std::vector<double> drops{1e-3, 0.011, 0.1, 0.103};
    std::vector<scene::Body> balls;
    for (std::size_t i = 0; i < drops.size(); ++i) {
      balls.push_back(ball(1e-3, e, "ball" + std::to_string(i)));
      balls[i].X_WO.translation() = Vector3d(-1.0, 0.2 * static_cast<double>(i), radius + drops[i]);
    }
    Simulation s(on_slab(balls), SimulationSettings());
    s.advance_to(0.0);
    std::vector<bool> bounces(drops.size(), true);
    for (int k = 1; k <= 50; ++k) {
      EXPECT_EQ(s.advance_to(0.02 * k).steps_unsolved, 0);
      for (std::size_t i = 0; i < drops.size(); ++i) {
        const Bouncing exact = bouncing(drops[i], e, across, slowest, 0.02 * k);
        bounces[i] = bounces[i] && exact.height > 0.0;
        if (!bounces[i]) continue;
        EXPECT_NEAR(place(s, balls[i].name).z() - radius, exact.height, exact.off) << e << ' ' << drops[i] << ' ' << k;
      }
    }
  }
}

TEST_P(LooseSlab, WhatTheContactsTellIsWhatTheBodyGot) {
  for (const double e : {0.0, 0.7}) {
    scene::Body body = ball(0.3, e);
    body.X_WO.translation() = Vector3d(-1.0, 0, radius + 0.1);
    Simulation s(on_slab({body}), SimulationSettings());
    s.advance_to(0.0);
    double told = 0.0;
    for (int i = 1; i <= 30; ++i) {
      s.advance_to(0.02 * i);
      for (const contact::ContactState& c : s.contacts()) {
        if (c.object != "body" && c.other != "body") continue;
        told += c.impulse * std::abs(c.n_W.dot(top().linear().col(2)));
      }
    }
    const Vector3d v = top().linear().transpose() * object(s, "body").V_WO_W.linear;
    const double given = v.z() + g * std::cos(GetParam().angle) * s.time();  // N·s, of 1 kg
    ASSERT_GT(given, 2.0);
    EXPECT_NEAR(told, given, 1e-3 * given) << e;
  }
}

// Loaded contacts have no restitution, whatever their material: what rests does not begin to tremble.
TEST_P(LooseSlab, WhatRestsOnAYieldingSlabStaysAtRest) {
  const double stiffness = 2e4;
  for (const double e : {0.0, 0.9}) {
    scene::Body body = box("body", Vector3d(0.1, 0.08, 0.06), 1.0, Vector3d(0.0, 0.0, 0.03 + 1e-3), 0.5);
    body.material.restitution = e;
    body.material.stiffness = stiffness;
    Simulation s(on_slab({body}), SimulationSettings());
    s.advance_to(0.0);
    s.advance_to(1.0);
    const double depth = g * std::cos(GetParam().angle) / stiffness;
    for (int i = 1; i <= 10; ++i) {
      s.advance_to(1.0 + 0.02 * i);
      EXPECT_NEAR(0.03 - place(s).z(), depth, 1e-2 * depth) << e;
      EXPECT_LT(object(s, "body").V_WO_W.linear.norm(), 1e-4) << e;
    }
  }
}

}  // namespace
}  // namespace spring_workbench::simulation::loose_slab_test
