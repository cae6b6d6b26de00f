// Motion of an object whose tool cannot comply with a contact: its proxy moves like the hand, apart from its
// compliance.
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "spring_workbench/math/so3.h"
#include "spring_workbench/simulation/simulation.h"
#include "support/bench_scenes.h"

namespace spring_workbench::simulation::proxy_motion_test {
namespace {

constexpr double side = 0.1, slab = 0.1, sample = 0.02;  // m, m, s

struct Floor {
  scene::ContactMode contact;
  bool movable;
  double height() const { return movable ? slab : 0.0; }
};
const Floor floors[] = {{scene::ContactMode::stop, false},
                        {scene::ContactMode::stop, true},
                        {scene::ContactMode::dynamic, false},
                        {scene::ContactMode::dynamic, true}};

scene::Scene on(const Floor& floor, double mass, double friction) {
  std::vector<scene::Body> bodies{
      box("held", Vector3d::Constant(side), mass, Vector3d(0, 0, floor.height() + 0.5 * side), friction)};
  if (floor.movable) bodies.push_back(box("slab", Vector3d(8, 8, slab), 1e6, Vector3d(0, 0, 0.5 * slab), friction));
  return scene_of(std::move(bodies), floor.contact, friction);
}

/// A hand that presses by 1 mm within 0.2 s and goes along x with this acceleration from 0.2 s on.
RigidTransform pressing(double t, const Floor& floor, double length, double acceleration) {
  const double u = std::min(t / 0.2, 1.0), gone = std::max(0.0, t - 0.2);
  return pointing_down({0.5 * acceleration * gone * gone, 0.0, floor.height() + 0.5 * side + length - 1e-3 * u});
}

TEST(Proxy, OfARigidToolThatSlidesAlongAFloorHasTheHandsVelocityAndKeepsItWhenItIsLetGo) {
  constexpr double acceleration = 2.0;
  for (const Floor& floor : floors) {
    for (const tools::Tool tool : {tools::Tool::direct, tools::Tool::ray, tools::Tool::spring_fork}) {
      for (const double step : {0.02, 0.004}) {
        SCOPED_TRACE(std::to_string(static_cast<int>(floor.contact)) + (floor.movable ? " movable " : " fixed ") +
                     std::to_string(static_cast<int>(tool)) + " " + std::to_string(step));
        SimulationSettings set;
        set.tool = tool;
        set.fork.dofs = {false, false, false};
        set.dynamics.step = step;
        set.grasp.object = "held";
        Simulation s(on(floor, 1.0, 0.4), set);
        for (double t = 0.0; t < 1.0; t += sample)
          s.push_stylus({t, pressing(t, floor, set.fork.length, acceleration)});
        for (double t = sample; t < 0.9; t += sample) {
          EXPECT_EQ(s.advance_to(t).steps_blocked, 0);
          if (t < 0.5) continue;  // friction has stretched the proxy's spring by then
          const Twist& V = s.objects()[0].V_WO_W;
          EXPECT_LT((V.linear - Vector3d(acceleration * (t - 0.2), 0, 0)).norm(), 1e-4) << t;
          EXPECT_LT(V.angular.norm(), 1e-3) << t;
        }
        const Twist held = s.objects()[0].V_WO_W;
        const Vector3d at = s.objects()[0].X_WO.translation();
        const double begin = s.time();
        ASSERT_TRUE(s.release());
        EXPECT_EQ(s.objects()[0].V_WO_W.linear, held.linear);
        s.advance_to(begin + sample);
        const double way = held.linear.x() * sample - 0.5 * 0.4 * 9.81 * sample * sample;  // Coulomb
        EXPECT_NEAR(s.objects()[0].X_WO.translation().x() - at.x(), way, 5e-3 * way);
      }
    }
  }
}

/// What presses a ball along a rigid direction, without friction, does not change what the springs do across it.
TEST(Proxy, OfAForkThatPressesLeavesTheMotionAcrossAlone) {
  constexpr double swing = 4e-4;  // m; so small, and pressed so little, that the rod stays straight
  const auto swings = [](const Floor& floor, double step, double pressed) {
    SimulationSettings set;
    set.fork.dofs = {false, true, false};
    set.fork.stiffness = {1e3, 400.0, 10.0};
    set.dynamics.step = step;
    set.grasp.object = "held";
    scene::Scene scene = on(floor, 1.0, 0.0);
    scene.bodies[0].collision = {{geometry::Sphere{0.5 * side}}};
    scene.gravity = 0.0;
    Simulation s(scene, set);
    for (double t = 0.0; t < 1.6; t += sample) {
      const double u = std::min(t / 0.2, 1.0), gone = std::max(0.0, t - 0.2);
      s.push_stylus({t, pointing_down({swing * std::pow(std::sin(6.0 * gone), 2), 0.0,
                                       floor.height() + 0.5 * side + set.fork.length - pressed * u})});
    }
    std::vector<bodies::BodyState> at;
    for (double t = sample; t < 1.5; t += sample) {
      s.advance_to(t);
      at.push_back(s.objects()[0]);
    }
    return at;
  };
  for (const Floor& floor : floors) {
    const std::vector<bodies::BodyState> free = swings(floor, 0.02, -0.01);
    for (const double step : {0.02, 0.005}) {
      const std::vector<bodies::BodyState> pressed = swings(floor, step, 1e-5);
      for (std::size_t i = 0; i < free.size(); ++i) {
        EXPECT_TRUE(i == 0 || pressed[i].in_contact) << step << " " << i;
        EXPECT_NEAR(pressed[i].X_WO.translation().x(), free[i].X_WO.translation().x(), 0.02 * swing)
            << step << " " << i;
        EXPECT_NEAR(pressed[i].V_WO_W.linear.x(), free[i].V_WO_W.linear.x(), 0.02 * 12.0 * swing) << step << " " << i;
      }
    }
  }
}

}  // namespace
}  // namespace spring_workbench::simulation::proxy_motion_test
