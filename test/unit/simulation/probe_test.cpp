// The tool spring_probe.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <utility>
#include <vector>

#include "spring_workbench/instruments/reading_average.h"
#include "spring_workbench/simulation/simulation.h"
#include "support/bench_scenes.h"

namespace spring_workbench::simulation::probe_test {
namespace {

constexpr double g = 9.81;

SimulationSettings with_probe(double stiffness) {
  SimulationSettings set;
  set.tool = tools::Tool::spring_probe;
  set.fork.length = 0.2;
  set.fork.stiffness.stretch = stiffness;
  return set;
}

/// A block whose top is at 0.1 m; without mass it is fixed.
scene::Scene block_of(double material, double mass) {
  scene::Scene scene = scene_of({box("block", {0.2, 0.2, 0.1}, mass, Vector3d(0, 0, 0.05))}, scene::ContactMode::stop);
  scene.bodies[0].material.stiffness = material;
  return scene;
}

/// A hand that presses the block from above by `depth` once or twice, up to `duration`; every 20 ms what it does and
/// what its tool tells as an instrument, whose tracker adds `noise` [m] to the hand's place. Returns the last touch at
/// its end.
struct Press {
  double material, probe, depth, duration = 2.0, noise = 0.0, mass = 0.0;

  template <typename Tell>
  instruments::ReadingAverage run(unsigned seed, Tell&& tell) const {
    std::mt19937 random(seed);
    std::normal_distribution<double> normal(0.0, noise);
    Simulation simulation(block_of(material, mass), with_probe(probe));
    instruments::ReadingAverage readings, of_touch;
    const int samples = static_cast<int>(duration / 0.02);
    const auto height = [&](double t) {
      return 0.3 + 0.02 -
             (0.02 + depth) * 0.5 * (1.0 - std::cos(2.0 * M_PI * std::round(0.5 * duration) / duration * t));
    };
    for (int k = 0; k <= samples; ++k) simulation.push_stylus({0.02 * k, pointing_down({0.0, 0.0, height(0.02 * k)})});
    for (int k = 0; k < samples; ++k) {
      simulation.advance_to(0.02 * k);
      tools::ToolState tool = simulation.tool();
      tool.X_WS.translation() += Vector3d(normal(random), normal(random), normal(random));
      readings.add(0.02 * k, tool, mass > 0.0 ? object(simulation, "block").X_WO : RigidTransform::Identity());
      if (!tool.touched.empty()) of_touch = readings;
      tell(tool);
    }
    return of_touch;
  }
};

TEST(Probe, PressesByTheMaterialInSeriesWithItsOwnSpring) {
  for (const double material : {1e2, 1e3, 1e4, 1e5, 1e6}) {
    for (const double probe : {100.0, 2000.0}) {
      double deepest = 0.0;
      Press{material, probe, 0.03}.run(1, [&](const tools::ToolState& tool) {
        const double depth = 0.1 + 0.2 - tool.X_WS.translation().z();
        EXPECT_EQ(tool.touched, depth > 1e-12 ? "block" : "");
        EXPECT_EQ(tool.held_object, "");
        const double force = std::max(depth, 0.0) / (1.0 / material + 1.0 / probe);
        EXPECT_NEAR(tool.handle_wrench_H.force.z(), -force, 1e-6 * force + 1e-9);
        EXPECT_NEAR(tool.stretch, -force / probe, 1e-6 * 0.03);
        if (depth > deepest && deepest > 0.01) {
          EXPECT_NEAR(tool.material_stiffness, material, 1e-4 * material);
        }
        deepest = std::max(deepest, depth);
      });
      EXPECT_NEAR(deepest, 0.03, 1e-3);
    }
  }
}

/// The estimator, given only the noisy tracker and the probe's force, has its nominal confidence, and reaches 5 % if
/// the material deforms enough.
TEST(Probe, MeasuresTheMaterialThroughATrackersNoise) {
  std::mt19937 random(11);
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  int covered = 0, sure = 0;
  constexpr unsigned touches = 1000;
  constexpr double noise = 5e-4;
  for (unsigned i = 0; i < touches; ++i) {
    const double material = std::pow(10.0, 2.0 + 4.0 * uniform(random));
    const double probe = std::pow(10.0, 3.0 + 3.0 * uniform(random));
    const Press press{material, probe, 0.01 + 0.04 * uniform(random), 2.0 + 2.0 * uniform(random), noise};
    std::vector<double> give;  // what the material gives way, in the last touch
    bool between = true;
    const auto readings = press.run(i, [&](const tools::ToolState& tool) {
      const double force = tool.handle_wrench_H.force.norm();
      if (force == 0.0) between = true;
      if (force > 0.0 && std::exchange(between, false)) give.clear();
      if (force > 0.0) give.push_back(force / material);
    });
    const auto reading = readings.material();
    ASSERT_TRUE(reading) << i;
    covered += reading->material.low <= material && material <= reading->material.high ? 1 : 0;
    double mean = 0.0, squares = 0.0;
    for (const double x : give) mean += x / static_cast<double>(give.size());
    for (const double x : give) squares += (x - mean) * (x - mean);
    // By the law of least squares: half an interval is 2 σ / √Σ(x − x̄)² of the value.
    if (2.0 * noise / std::sqrt(squares) > 0.02) continue;
    ++sure;
    EXPECT_LT(reading->material.high - reading->material.low, 0.05 * material) << material << " " << probe;
  }
  EXPECT_NEAR(static_cast<double>(covered) / touches, 0.95, 0.02);
  EXPECT_GT(sure, 200);
}

/// The probe has a damper of its own on an object that can move, which is not the material's: that has none. In contact
/// the object's velocity is a little off, and with it the force of the damper.
TEST(Probe, OfAMovableBlockItReadsHardlyAnyDamping) {
  for (unsigned i = 0; i < 50; ++i) {
    double own = 0.0;
    const Press press{1e4, 2e3, 0.03, 2.0, 5e-4, 3.0};
    const auto readings = press.run(i, [&](const tools::ToolState& tool) { own = std::max(own, tool.probe_damping); });
    const auto reading = readings.material();
    ASSERT_TRUE(reading) << i;
    EXPECT_GT(own, 100.0);
    EXPECT_LT(std::abs(reading->damping.value), 0.2 * own) << i;
    EXPECT_NEAR(reading->touch.value, 1.0 / (1.0 / 1e4 + 1.0 / 2e3), 0.1 * 1667.0) << i;
  }
}

TEST(Probe, ARigidBodyReadsAsInfinite) {
  const auto readings = Press{std::numeric_limits<double>::infinity(), 2000.0, 0.03}.run(1, [](const auto&) {});
  ASSERT_TRUE(readings.material());
  EXPECT_EQ(readings.material()->material.value, std::numeric_limits<double>::infinity());
  EXPECT_EQ(readings.material()->material.high, std::numeric_limits<double>::infinity());
}

TEST(Probe, TheAirIsNoReading) {
  const auto readings = Press{1e4, 2000.0, -0.01}.run(1, [](const tools::ToolState& tool) {
    EXPECT_EQ(tool.touched, "");
    EXPECT_EQ(tool.material_stiffness, 0.0);
    EXPECT_EQ(tool.handle_wrench_H.force.norm(), 0.0);
  });
  EXPECT_FALSE(readings.material());
  EXPECT_TRUE(readings.force_over_depth().empty());
}

TEST(Probe, PressesTheBench) {
  scene::Scene scene = scene_of({}, scene::ContactMode::none);
  scene.bench_material.stiffness = 5e3;
  Simulation simulation(scene, with_probe(1000.0));
  simulation.push_stylus({0.0, pointing_down({0.3, 0.0, 0.18})});
  simulation.advance_to(0.1);
  EXPECT_EQ(simulation.tool().touched, "workbench");
  EXPECT_NEAR(simulation.tool().handle_wrench_H.force.z(), -0.02 / (1.0 / 5e3 + 1.0 / 1e3), 1e-6);
}

/// The probe level, pointing along x.
RigidTransform level(const Vector3d& p) {
  return make_transform(p, Quaterniond(Eigen::AngleAxisd(0.5 * 3.14159265358979323846, Vector3d::UnitY())));
}

TEST(Probe, PushesABoxAlongTheBenchAgainstFriction) {
  for (const scene::ContactMode contact : {scene::ContactMode::stop, scene::ContactMode::dynamic}) {
    const double mu = 0.4, probe = 500.0;
    Simulation simulation(scene_of({box("box", {0.1, 0.1, 0.06}, 1.0, Vector3d(0.15, 0, 0.03), mu)}, contact, mu),
                          with_probe(probe));
    for (double t = 0.0; t < 2.0; t += 0.02) simulation.push_stylus({t, level({-0.15 + 0.1 * t, 0.0, 0.02})});
    simulation.advance_to(1.8);
    const tools::ToolState tool = simulation.tool();
    EXPECT_EQ(tool.touched, "box");
    EXPECT_FALSE(simulation.objects()[0].held);
    // At constant speed the push is the friction, and the box is that much ahead of where the tip would be.
    EXPECT_NEAR(tool.tip_wrench_W.force.x(), mu * g, 0.02 * mu * g);
    EXPECT_NEAR(simulation.objects()[0].V_WO_W.linear.x(), 0.1, 2e-3);
    EXPECT_NEAR(simulation.objects()[0].X_WO.translation().x() - 0.05, -0.15 + 0.18 + 0.2 - mu * g / probe, 1e-3);
    // When withdrawn, it leaves the box in place.
    for (double t = 2.0; t < 3.0; t += 0.02) simulation.push_stylus({t, level({0.05 - 0.2 * (t - 2.0), 0.0, 0.02})});
    simulation.advance_to(3.0);
    EXPECT_EQ(simulation.tool().touched, "");
    EXPECT_LT(simulation.objects()[0].V_WO_W.linear.norm(), 1e-2);
  }
}

TEST(Probe, NoStiffnessMakesAPushBlowUp) {
  for (const double stiffness : {0.0, 1.0, 1e6, 1e12}) {
    for (const double material : {1e2, 1e6, std::numeric_limits<double>::infinity()}) {
      scene::Scene scene =
          scene_of({box("box", {0.1, 0.1, 0.06}, 0.1, Vector3d(0.15, 0, 0.5))}, scene::ContactMode::none);
      scene.bodies[0].material.stiffness = material;
      scene.gravity = 0.0;
      Simulation simulation(scene, with_probe(stiffness));
      for (double t = 0.0; t < 2.0; t += 0.02) simulation.push_stylus({t, level({-0.15 + 0.2 * t, 0.01, 0.5})});
      simulation.advance_to(1.9);
      const bodies::BodyState& o = simulation.objects()[0];
      ASSERT_TRUE(o.X_WO.matrix().allFinite()) << stiffness;
      EXPECT_LT(o.V_WO_W.linear.norm(), 1.0) << stiffness << " " << material;
    }
  }
}

TEST(Probe, CannotHold) {
  Simulation simulation(scene_of({box("box", {0.1, 0.1, 0.06}, 1.0, Vector3d(0, 0, 0.5))}, scene::ContactMode::none),
                        SimulationSettings());
  push_move(simulation, 0.0, 1.0, Vector3d(0, 0, 0.7), Vector3d(0.2, 0, 0.8));
  simulation.push_button(0.0, true);
  simulation.advance_to(0.5);
  ASSERT_EQ(simulation.tool().held_object, "box");
  const bodies::BodyState before = simulation.objects()[0];
  EXPECT_NE(simulation.select_tool(tools::Tool::spring_probe).message.find("released"), std::string::npos);
  EXPECT_FALSE(simulation.objects()[0].held);
  EXPECT_LT((simulation.objects()[0].V_WO_W.linear - before.V_WO_W.linear).norm(), 1e-12);
}

}  // namespace
}  // namespace spring_workbench::simulation::probe_test
