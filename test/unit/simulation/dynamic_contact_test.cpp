// Contact mode `dynamic`: the held object among movable ones.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "spring_workbench/math/so3.h"
#include "spring_workbench/simulation/simulation.h"

namespace spring_workbench {
namespace {

constexpr double g = 9.81;

Body box(const std::string& name, const Vector3d& size, double mass, const Vector3d& p_WO, double friction = 0.5) {
  Body b;
  b.name = name;
  b.movable = mass > 0.0;
  b.X_WO.translation() = p_WO;
  b.mass_properties.mass = mass;
  const Vector3d s = size.cwiseAbs2();
  b.mass_properties.inertia_O =
      (mass / 12.0 * Vector3d(s.y() + s.z(), s.x() + s.z(), s.x() + s.y())).asDiagonal();
  b.material.friction = friction;
  b.collision.push_back({Box{size}});
  return b;
}

Scene scene_of(std::vector<Body> bodies, double friction = 0.5) {
  Scene s;
  s.name = s.path = "dynamic";
  s.contact = ContactMode::dynamic;
  s.bodies = std::move(bodies);
  s.bench_material.friction = friction;
  return s;
}

RigidTransform pointing_down(const Vector3d& p) { return make_transform(Quaterniond(0.0, 1.0, 0.0, 0.0), p); }

/// Samples at 50 Hz from `a` to `b` in minimum jerk.
void push_move(Simulation& simulation, double t0, double t1, const Vector3d& a, const Vector3d& b) {
  for (double t = t0; t < t1 + 1e-9; t += 0.02) {
    const double u = (t - t0) / (t1 - t0);
    simulation.push_stylus({t, pointing_down(a + u * u * u * (10.0 + u * (-15.0 + 6.0 * u)) * (b - a))});
  }
}

/// Samples at 50 Hz from `a` to `b` at constant speed.
void push_line(Simulation& simulation, double t0, double t1, const Vector3d& a, const Vector3d& b) {
  for (double t = t0; t < t1 + 1e-9; t += 0.02) simulation.push_stylus({t, pointing_down(a + (t - t0) / (t1 - t0) * (b - a))});
}

const BodyState& object(const Simulation& s, const std::string& name) {
  return *std::find_if(s.objects().begin(), s.objects().end(), [&](const BodyState& o) { return o.name == name; });
}

// The drag scene: 5 kg pressed 0.1 m below the plane by the hand, dragged 0.5 m; with springs that do not bend into each
// other the lag is μ k_stretch 0.1 m / k_bend, and the weight presses beside.
TEST(DynamicContact, DraggedBoxLagsByCoulombsLaw) {
  for (const double factor : {0.1, 1.0, 1e6}) {
    for (const double mu : {0.0, 0.5, 1.0}) {
      Scene scene = scene_of({box("box", Vector3d(0.2, 0.1, 0.05), 5.0, Vector3d(0, 0, 0.025), mu)}, mu);
      SimulationSettings set;
      set.fork.shape = "bushing";
      set.fork.length = 0.2;
      set.fork.stiffness = {5000.0 * factor, 5000.0 * factor, 200.0 * factor};
      set.grasp.object = "box";
      Simulation s(scene, set);
      const double z = 0.225;
      push_move(s, 0.0, 1.0, {0, 0, z}, {0, 0, z - 0.1});
      push_line(s, 1.02, 6.02, {0, 0, z - 0.1}, {0.5, 0, z - 0.1});
      s.advance(6.0);
      const double pressed = 5000.0 * factor * 0.1 + 5.0 * g;
      const Vector3d p = s.objects()[0].X_WO.translation();
      const double lag = s.fork().X_WH.translation().x() - p.x();
      // Friction acts below the tip: the slope spring gives way to its moment, the flush face does not let it.
      EXPECT_NEAR(lag, mu * pressed / (5000.0 * factor), 1e-3 * std::max(mu, 0.1) * 0.1) << factor << " " << mu;
      EXPECT_NEAR(p.z(), 0.025, 1e-5) << factor << " " << mu;
    }
  }
}

TEST(DynamicContact, LiftsAStackAndPutsItDown) {
  Scene scene = scene_of({box("lower", Vector3d(0.1, 0.1, 0.04), 1.0, Vector3d(0, 0, 0.02)),
                          box("upper", Vector3d(0.06, 0.06, 0.04), 0.5, Vector3d(0.02, 0, 0.06))});
  SimulationSettings set;
  set.fork.stiffness = {5000.0, 5000.0, 50.0};
  set.grasp.object = "lower";
  Simulation s(scene, set);
  const Vector3d start(0, 0, 0.02 + set.fork.length);
  push_move(s, 0.0, 1.0, start, start + Vector3d(0, 0, 0.1));
  s.advance(0.98);
  push_move(s, 1.02, 2.0, start + Vector3d(0, 0, 0.1), start + Vector3d(0, 0, 0.1));
  s.advance(1.98);
  const RigidTransform X = object(s, "lower").X_WO;
  const Vector3d on_top = X.inverse() * object(s, "upper").X_WO.translation();
  EXPECT_NEAR(X.translation().z(), 0.12 - 1.5 * g / 5000.0, 1e-3);
  EXPECT_LT((on_top - Vector3d(0.02, 0, 0.04)).norm(), 1e-3);
  EXPECT_FALSE(object(s, "upper").asleep);
  push_move(s, 2.02, 3.0, start + Vector3d(0, 0, 0.1), start);
  push_move(s, 3.02, 5.0, start, start);
  s.advance(5.0);
  EXPECT_NEAR(object(s, "upper").X_WO.translation().z(), 0.06, 2e-4);
}

TEST(DynamicContact, PushesANeighbourAlong) {
  Scene scene = scene_of({box("pusher", Vector3d(0.1, 0.1, 0.04), 1.0, Vector3d(0, 0, 0.03)),
                          box("pushed", Vector3d(0.1, 0.1, 0.06), 1.0, Vector3d(0.2, 0, 0.03))});
  SimulationSettings set;
  set.grasp.object = "pusher";
  Simulation s(scene, set);
  const Vector3d start(0, 0, 0.04 + set.fork.length);
  push_move(s, 0.0, 2.0, start, start + Vector3d(0.3, 0, 0));
  s.advance(1.98);
  const double gap = object(s, "pushed").X_WO.translation().x() - object(s, "pusher").X_WO.translation().x() - 0.1;
  EXPECT_NEAR(gap, 0.0, 2e-3);
  EXPECT_NEAR(object(s, "pushed").X_WO.translation().z(), 0.03, 1e-4);
}

TEST(DynamicContact, NoHeldObjectGoesThroughAThinWall) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  for (int run = 0; run < 4; ++run) {
    // A room of 1 mm walls; a long thin box inside, swung about at up to 5 m/s and 50 rad/s.
    std::vector<Body> bodies{box("rod", Vector3d(0.3, 0.01, 0.01), 0.3, Vector3d(0, 0, 0.5), 0.3)};
    for (int axis = 0; axis < 3; ++axis) {
      for (const double side : {-0.25, 0.25}) {
        Vector3d size(0.6, 0.6, 0.6), centre(0, 0, 0.5);
        size[axis] = 0.001;
        centre[axis] += side;
        bodies.push_back(box("wall" + std::to_string(bodies.size()), size, 0.0, centre));
      }
    }
    SimulationSettings set;
    set.grasp.object = "rod";
    set.fork.length = 0.05;
    set.fork.stiffness = {2000.0, 2000.0, 2.0};
    Simulation s(scene_of(bodies), set);
    const Vector3d v = 5.0 * Vector3d(unit(random), unit(random), unit(random)) / std::sqrt(3.0);
    const Vector3d w = 50.0 * Vector3d(unit(random), unit(random), unit(random)) / std::sqrt(3.0);
    for (int k = 0; k <= 10; ++k) {
      RigidTransform X = pointing_down({0, 0, 0.55});
      X.translation() += 0.02 * k * v;
      X.linear() = exp_so3(0.02 * k * w) * X.linear();
      s.push_stylus({0.02 * k, X});
    }
    s.advance(0.2);
    const RigidTransform& X = s.objects()[0].X_WO;
    ASSERT_TRUE(X.matrix().allFinite());
    for (const double end : {-0.15, 0.15}) {
      const Vector3d p = X * Vector3d(end, 0, 0) - Vector3d(0, 0, 0.5);
      EXPECT_LT(p.cwiseAbs().maxCoeff(), 0.25 + 1e-4) << run;
    }
  }
}

TEST(DynamicContact, LightAndHeavyStiffAndSoftAgainstAWallStayBounded) {
  for (const double mass : {0.1, 1.0, 1e6}) {
    for (const double k : {1e1, 1e3, 1e5}) {
      Scene scene = scene_of({box("box", Vector3d(0.1, 0.1, 0.1), mass, Vector3d(0, 0, 0.5)),
                              box("wall", Vector3d(0.1, 1.0, 1.0), 0.0, Vector3d(0.3, 0, 0.5))});
      scene.gravity = 0.0;
      SimulationSettings set;
      set.fork.stiffness = {k, k, k * 0.01};
      set.grasp.object = "box";
      Simulation s(scene, set);
      const Vector3d start(0, 0, 0.5 + set.fork.length);
      push_move(s, 0.0, 0.5, start, start + Vector3d(0.22, 0, 0));
      push_move(s, 0.52, 1.0, start + Vector3d(0.22, 0, 0), start + Vector3d(0.22, 0, 0));
      s.advance(1.0);
      const RigidTransform& X = s.objects()[0].X_WO;
      ASSERT_TRUE(X.matrix().allFinite()) << mass << " " << k;
      EXPECT_LT(X.translation().x(), 0.2 + 1e-3) << mass << " " << k;
      EXPECT_LT((X.translation() - Vector3d(0, 0, 0.5)).norm(), 1.0) << mass << " " << k;
    }
  }
}

}  // namespace
}  // namespace spring_workbench
