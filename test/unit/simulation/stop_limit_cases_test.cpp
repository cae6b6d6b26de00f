// Contact mode `stop` with extreme masses, stiffnesses and starts: finite, bounded, and no energy is created.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "spring_workbench/simulation/simulation.h"
#include "support/bench_scenes.h"

namespace spring_workbench::simulation::stop_limit_cases_test {
namespace {

constexpr double edge = 0.1;  // m, of the held box

/// How deep the box is in the wall that begins at `wall_x`, or in the bench [m].
double depth_of(const RigidTransform& X, double wall_x) {
  const Vector3d reach = 0.5 * edge * X.linear().cwiseAbs().rowwise().sum();
  return std::max(X.translation().x() + reach.x() - wall_x, reach.z() - X.translation().z());
}

double energy(const Simulation& s, const scene::Scene& scene) {
  const tools::ToolState fork = s.tool();
  return fork.elastic_energy + fork.kinetic_energy +
         scene.bodies[0].mass_properties.mass * scene.gravity * s.objects()[0].X_WO.translation().z();
}

class PressedAndShifted : public ::testing::TestWithParam<double> {};  // by damping ratio
INSTANTIATE_TEST_SUITE_P(StopLimitCases, PressedAndShifted, ::testing::Values(0.1, 1.0, 10.0), [](const auto& tested) {
  return tested.param < 1.0 ? "underdamped" : tested.param > 1.0 ? "overdamped" : "critical";
});

TEST_P(PressedAndShifted, Follow) {
  constexpr double wall_x = 0.25;
  unsigned seed = 0;
  for (const double mass : {1e-6, 1e-3, 1.0, 1e3, 1e6}) {
    for (const double k : {1e-2, 1.0, 1e3, 1e6, 1e9}) {
      const bool on_bench = ++seed % 2 == 0;
      std::mt19937 random(seed);
      std::uniform_real_distribution<double> unit(-1.0, 1.0);
      const double height = on_bench ? 0.5 * edge : 0.5;
      scene::Scene scene = scene_of({box("box", Vector3d::Constant(edge), mass, Vector3d(0, 0, height)),
                                     box("wall", Vector3d(0.1, 1.0, 1.0), 0.0, Vector3d(wall_x + 0.05, 0, 0.5))},
                                    scene::ContactMode::stop);
      scene.gravity = on_bench ? 9.81 : 0.0;
      SimulationSettings set;
      set.fork.stiffness = {k, k, 0.01 * k};
      set.fork.damping_ratio = {GetParam(), GetParam(), GetParam()};
      set.grasp.object = "box";
      Simulation s(scene, set);
      const Vector3d start(0, 0, height + set.fork.length);
      const Vector3d in = start + Vector3d(0.22, 0.03 * unit(random), 0.03 * unit(random));
      const Vector3d along = in + Vector3d(0.01, 0.1 * unit(random), on_bench ? -0.01 : 0.1 * unit(random));
      push_move(s, 0.0, 0.5, start, in, 0.3 * unit(random));
      push_move(s, 0.52, 1.0, in, along);
      push_move(s, 1.02, 3.0, along, along);
      double hardest = mass * scene.gravity, least = 0.0;
      for (int i = 1; i <= 150; ++i) {
        const AdvanceReport report = s.advance_to(0.02 * i);
        EXPECT_EQ(report.steps_rejected, 0);
        EXPECT_EQ(report.steps_blocked, 0) << mass << " " << k << " " << i;
        const bodies::BodyState& o = s.objects()[0];
        ASSERT_TRUE(o.X_WO.matrix().allFinite() && o.V_WO_W.linear.allFinite()) << mass << " " << k;
        EXPECT_LT(depth_of(o.X_WO, wall_x), 2.1e-5) << mass << " " << k << " " << i;
        EXPECT_LT(o.V_WO_W.linear.norm(), 1.5) << mass << " " << k << " " << i;  // the hand's fastest is 0.83 m/s
        const double now = energy(s, scene);
        double force = 0.0;
        for (const contact::ContactState& c : s.contacts()) force += c.force;
        hardest = std::max(hardest, force);
        if (i <= 52) {
          least = now;
          continue;
        }
        // With the hand at rest, energy may grow by at most the equivalent of the allowed contact depth of 3 µm
        // (doc/model.md).
        EXPECT_LE(now - least, 3e-6 * hardest + 1e-12 * now) << mass << " " << k << " " << i;
        least = std::min(least, now);
      }
    }
  }
}

TEST(StopLimitCases, AThousandTimesHeavierOrLighterRestsOnTheOther) {
  for (const double upper_mass : {1e-3, 1.0, 1e3}) {
    const Vector3d size = Vector3d::Constant(edge);
    Simulation s(scene_of({box("lower", size, 1.0, Vector3d(0, 0, 0.05)),
                           box("upper", size, upper_mass, Vector3d(0.02, 0, 0.15))},
                          scene::ContactMode::stop),
                 SimulationSettings());
    s.advance_to(0.0);
    s.place({{"lower", RigidTransform(Eigen::Translation3d(0, 0, 0.06))},
             {"upper", RigidTransform(Eigen::Translation3d(0.02, 0, 0.2))}});
    for (int i = 1; i <= 100; ++i) EXPECT_EQ(s.advance_to(0.02 * i).steps_rejected, 0);
    for (const bodies::BodyState& o : s.objects()) {
      EXPECT_TRUE(o.asleep) << o.name << " " << upper_mass;
      EXPECT_NEAR(o.X_WO.translation().z(), o.name == "lower" ? 0.05 : 0.15, 1e-5) << upper_mass;
    }
  }
}

/// Pressed onto a ledge that reaches under it by so little that the way out sideways is the shorter one as soon as it
/// is in it: it lies on the ledge under the load, or turns off it, but does not hang there without a force.
TEST(StopLimitCases, OnALedgeOfAFractionOfAMillimetreItRestsOrTurnsOff) {
  constexpr double height = 0.5, above = 5e-3, lowered = 0.01, k = 1e4;
  for (const double tilt : {0.0, 0.02, 0.3}) {
    for (const double ledge : {9e-4, 3e-4, 5e-5}) {
      scene::Body held = box("box", Vector3d::Constant(edge), 1.0, Vector3d(0, 0, height));
      held.X_WO.linear() = Eigen::AngleAxisd(tilt, Vector3d::UnitY()).toRotationMatrix();
      const Vector3d corner = held.X_WO * Vector3d(0.5 * edge, 0.0, -0.5 * edge);  // the lowest
      const Vector3d shelf = corner + Vector3d(0.05 - ledge, 0.0, -0.05 - above);
      SimulationSettings set;
      set.fork.stiffness = {k, k, 0.01 * k};
      set.grasp.object = "box";
      Simulation s(scene_of({held, box("shelf", Vector3d(0.1, 1.0, 0.1), 0.0, shelf)}, scene::ContactMode::stop), set);
      const Vector3d start(0, 0, height + set.fork.length), end = start - lowered * Vector3d::UnitZ();
      push_move(s, 0.0, 0.5, start, end);
      push_move(s, 0.52, 1.0, end, end);
      double hardest = 0.0;
      for (int i = 1; i <= 50; ++i) {
        EXPECT_EQ(s.advance_to(0.02 * i).steps_blocked, 0) << tilt << " " << ledge << " " << i;
        double force = 0.0;
        for (const contact::ContactState& c : s.contacts()) force += c.force;
        hardest = std::max(hardest, force);
      }
      EXPECT_GT(hardest, 9.81) << tilt << " " << ledge;  // its weight alone
    }
  }
}

/// Grasped while it touches bench and neighbour, or penetrates the neighbour by `overlap`: it is separated without
/// being ejected.
TEST(StopLimitCases, GraspedWhileItTouchesOrOverlapsItComesAlong) {
  for (const double overlap : {0.0, 1e-4, 5e-3}) {
    for (const double k : {100.0, 1e5}) {
      Simulation s(scene_of({box("box", Vector3d::Constant(edge), 1.0, Vector3d(0, 0, 0.05)),
                             box("block", Vector3d(0.1, 1.0, 1.0), 0.0, Vector3d(0.1 - overlap, 0, 0.5))},
                            scene::ContactMode::stop),
                   [&] {
                     SimulationSettings set;
                     set.fork.stiffness = {k, k, 0.01 * k};
                     set.grasp.object = "box";
                     return set;
                   }());
      const Vector3d start(0, 0, 0.05 + SimulationSettings().fork.length);
      const Vector3d end = start + Vector3d(-0.1, 0, 0.15);
      push_move(s, 0.0, 0.5, start, start);
      push_move(s, 0.52, 1.5, start, end);
      push_move(s, 1.52, 4.0, end, end);
      for (int i = 1; i <= 200; ++i) {
        EXPECT_EQ(s.advance_to(0.02 * i).steps_rejected, 0);
        const bodies::BodyState& o = s.objects()[0];
        ASSERT_TRUE(o.X_WO.matrix().allFinite());
        EXPECT_LT(depth_of(o.X_WO, 0.05 - overlap), overlap + 2e-5) << overlap << " " << k << " " << i;
        EXPECT_LT(o.V_WO_W.linear.norm(), 1.5 + overlap / 5e-3) << overlap << " " << k << " " << i;
      }
      EXPECT_NEAR(s.objects()[0].X_WO.translation().x(), -0.1, 1e-3) << overlap << " " << k;
    }
  }
}

TEST(StopLimitCases, AMasslessOneFollowsTheHandAndStaysOutOfTheBench) {
  scene::Body light = box("light", Vector3d::Constant(edge), 1.0, Vector3d(0, 0, 0.05));
  light.mass_properties = scene::MassProperties();
  SimulationSettings set;
  set.grasp.object = "light";
  Simulation s(scene_of({light}, scene::ContactMode::stop), set);
  const Vector3d start(0, 0, 0.05 + set.fork.length);
  push_move(s, 0.0, 0.5, start, start + Vector3d(0.1, 0, -0.03), 0.5);
  push_move(s, 0.52, 1.0, start + Vector3d(0.1, 0, -0.03), start + Vector3d(0.2, 0, 0.1));
  push_move(s, 1.02, 2.0, start + Vector3d(0.2, 0, 0.1), start + Vector3d(0.2, 0, 0.1));
  for (int i = 1; i <= 100; ++i) {
    EXPECT_EQ(s.advance_to(0.02 * i).steps_rejected, 0);
    ASSERT_TRUE(s.objects()[0].X_WO.matrix().allFinite());
    EXPECT_LT(depth_of(s.objects()[0].X_WO, 10.0), 1e-5) << i;
  }
  EXPECT_LT((s.objects()[0].X_WO.translation() - Vector3d(0.2, 0, 0.15)).norm(), 1e-6);
}

}  // namespace
}  // namespace spring_workbench::simulation::stop_limit_cases_test
