// Contact of materials that have a stiffness: their compliances are in series with each other and with the tool, for
// every tool, shape and contact mode.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "spring_workbench/validation/names.h"
#include "support/bench_scenes.h"
#include "support/meshes.h"
#include "support/random_poses.h"

namespace spring_workbench::simulation::compliant_contact_test {
namespace {

using scene::ContactMode;

constexpr double g = 9.81;

class Compliant : public testing::TestWithParam<ContactMode> {};
INSTANTIATE_TEST_SUITE_P(Modes, Compliant, testing::Values(ContactMode::stop, ContactMode::dynamic),
                         [](const auto& tested) { return validation::name_of(tested.param); });

scene::Body with_stiffness(scene::Body body, double stiffness) {
  body.material.stiffness = stiffness;
  return body;
}

/// In contact mode `dynamic` something movable that is near but not touched: the rigid-body world takes the step.
void add_neighbour(scene::Scene& scene, const Vector3d& p_W) {
  if (scene.contact == ContactMode::dynamic)
    scene.bodies.push_back(box("neighbour", Vector3d(0.05, 0.05, 0.05), 1.0, p_W));
}

/// Sum of the forces on an object, and the largest depth of its contacts.
struct Pressure {
  double force = 0.0, depth = 0.0;
};
Pressure pressure(const Simulation& simulation, const std::string& name) {
  Pressure p;
  for (const contact::ContactState& c : simulation.contacts()) {
    if (c.object != name) continue;
    p.force += c.force;
    p.depth = std::max(p.depth, c.depth);
  }
  return p;
}

/// How deep the lowest point of a box is below the bench.
double depth_of_box(const bodies::BodyState& o, const Vector3d& size) {
  const Eigen::RowVector3d z = o.X_WO.linear().row(2);
  return 0.5 * z.cwiseAbs().dot(size) - o.X_WO.translation().z();
}

TEST_P(Compliant, RestsAtItsWeightTimesTheComplianceWhateverItsShape) {
  constexpr double bench = 5e4, own = 2e4, mass = 1.3;
  const double depth = mass * g * (1.0 / bench + 1.0 / own);
  const Vector3d size(0.1, 0.06, 0.04);
  for (const double step : {0.02, 5e-3}) {
    for (const geometry::Geometry& geometry :
         {geometry::Geometry(geometry::Box{size}), geometry::Geometry(geometry::Sphere{0.02}),
          geometry::Geometry(geometry::Cylinder{0.03, 0.04}), geometry::Geometry(test_support::box_mesh(size))}) {
      scene::Body body = with_stiffness(box("body", size, mass, Vector3d(0.2, -0.1, 0.02 + 5e-4)), own);
      body.X_WO.linear() = Eigen::AngleAxisd(0.4, Vector3d::UnitZ()).toRotationMatrix();
      body.collision[0].geometry = geometry;
      scene::Scene scene = scene_of({body}, GetParam());
      scene.bench_material.stiffness = bench;
      add_neighbour(scene, Vector3d(0.2, -0.1 + 0.0615 + 0.025, 0.025 + 5e-4));
      SimulationSettings set;
      set.dynamics.step = step;
      Simulation s(scene, set);
      s.advance_to(0.0);
      const AdvanceReport report = s.advance_to(3.0);
      EXPECT_NEAR(0.02 - object(s, "body").X_WO.translation().z(), depth, 5e-3 * depth + 1e-6) << geometry.index();
      EXPECT_NEAR(pressure(s, "body").force, mass * g, 1e-2 * mass * g) << geometry.index() << " " << step;
      EXPECT_TRUE(object(s, "body").asleep) << geometry.index() << " " << step;
      EXPECT_EQ(report.steps_blocked, 0) << geometry.index();
      EXPECT_EQ(report.steps_unsolved, 0) << geometry.index();
    }
  }
}

TEST(CompliantStack, EachPairCarriesWhatIsAboveIt) {
  const std::vector<double> stiffness{3e4, std::numeric_limits<double>::infinity(), 1e4}, mass{2.0, 0.5, 1.0};
  std::vector<scene::Body> bodies;
  for (std::size_t i = 0; i < 3; ++i) {
    bodies.push_back(with_stiffness(
        box("box " + std::to_string(i), Vector3d(0.1, 0.1, 0.05), mass[i],
            Vector3d(0.01 * static_cast<double>(i), 0.0, 0.025 + 5e-4 + (0.05 + 5e-4) * static_cast<double>(i))),
        stiffness[i]));
  }
  Simulation s(scene_of(bodies, ContactMode::dynamic), SimulationSettings());
  s.advance_to(0.0);
  const AdvanceReport report = s.advance_to(4.0);
  EXPECT_EQ(report.steps_unsolved, 0);
  double z = 0.0, above = 3.5;
  for (std::size_t i = 0; i < 3; ++i) {
    z += 0.05 - above * g * (1.0 / stiffness[i] + (i > 0 ? 1.0 / stiffness[i - 1] : 0.0));
    above -= mass[i];
    EXPECT_NEAR(s.objects()[i].X_WO.translation().z(), z - 0.025, 2e-5) << i;
  }
}

/// The hand goes `press` further than to where the object touches: without weight, spring and materials share it.
TEST_P(Compliant, EveryToolPressesInSeriesWithTheMaterials) {
  constexpr double own = 3e4, wall = 1e4, press = 0.02;
  const double compliance = 1.0 / own + 1.0 / wall;
  for (const tools::Tool tool :
       {tools::Tool::spring_fork, tools::Tool::spring, tools::Tool::direct, tools::Tool::ray}) {
    for (const double k : {200.0, 2e4, 2e6}) {
      const Vector3d size(0.06, 0.08, 0.04);
      scene::Scene scene =
          scene_of({with_stiffness(box("held", size, 0.4, Vector3d(0, 0, 0.2)), own),
                    with_stiffness(box("block", Vector3d(0.3, 0.3, 0.1), 0.0, Vector3d(0.02, 0.01, 0.1)), wall)},
                   GetParam());
      scene.gravity = 0.0;
      add_neighbour(scene, Vector3d(0.0, 0.04 + 0.025 + 1e-3, 0.15 + 0.025));
      SimulationSettings set;
      set.tool = tool;
      set.fork.stiffness.stretch = k;
      set.fork.dofs = {true, false, false};
      set.grasp.object = "held";
      Simulation s(scene, set);
      const Vector3d start(0.0, 0.0, 0.2 + (tool == tools::Tool::direct ? 0.0 : set.fork.length));
      push_move(s, 0.0, 1.0, start, start - Vector3d(0.0, 0.0, 0.03 + press));
      push_move(s, 1.02, 2.0, start - Vector3d(0.0, 0.0, 0.03 + press), start - Vector3d(0.0, 0.0, 0.03 + press));
      s.push_button(0.0, true);
      AdvanceReport report;
      for (double t = 0.02; t < 1.99; t += 0.02) report.add(s.advance_to(t));
      EXPECT_EQ(report.steps_blocked, 0) << validation::name_of(tool) << " " << k;
      ASSERT_EQ(s.tool().held_object, "held") << validation::name_of(tool);
      const Pressure at = pressure(s, "held");
      const double depth = 0.17 - s.objects()[0].X_WO.translation().z();
      EXPECT_NEAR(depth, compliance * at.force, 2e-3 * depth + 2e-6) << validation::name_of(tool) << " " << k;
      EXPECT_GT(at.force, 0.0) << validation::name_of(tool) << " " << k;
      if (tool == tools::Tool::spring_fork || tool == tools::Tool::spring) {
        EXPECT_NEAR(at.force, press / (1.0 / k + compliance), 5e-3 * at.force) << validation::name_of(tool) << " " << k;
      }
    }
  }
}

/// Held off its centre and pressed askew, it stands on an edge or a corner: the deepest point carries all of it.
TEST_P(Compliant, PressedAskewItIsAsDeepAsTheWholeForceMakesIt) {
  constexpr double bench = 2e4;
  for (const double turn : {0.0, 0.3}) {
    scene::Body held = box("held", Vector3d(0.1, 0.06, 0.04), 0.5, Vector3d(0, 0, 0.05));
    scene::Scene scene = scene_of({held}, GetParam());
    scene.bench_material.stiffness = bench;
    add_neighbour(scene, Vector3d(0.0, 0.05 + 0.025, 0.025));
    SimulationSettings set;
    set.grasp.object = "held";
    Simulation s(scene, set);
    const Vector3d start(0.03, 0.01, 0.05 + set.fork.length);
    push_move(s, 0.0, 1.0, start, start - Vector3d(0.01, 0.0, 0.06), turn);
    for (double t = 1.02; t < 4.0; t += 0.02)
      s.push_stylus({t, pointing_down(start - Vector3d(0.01, 0.0, 0.06), turn)});
    s.push_button(0.0, true);
    const AdvanceReport report = s.advance_to(3.9);
    s.advance_to(3.92);
    EXPECT_EQ(report.steps_blocked, 0);
    const Pressure at = pressure(s, "held");
    EXPECT_GT(at.force, 5.0);
    EXPECT_NEAR(depth_of_box(s.objects()[0], Vector3d(0.1, 0.06, 0.04)), at.force / bench, 2e-2 * at.force / bench);
  }
}

/// Energy of motion and height, and what contact with the bench stores.
double energy_of(const bodies::BodyState& o, const scene::Body& body, const Vector3d& size, double stiffness) {
  const Vector3d w = o.X_WO.linear().transpose() * o.V_WO_W.angular;
  const double mass = body.mass_properties.mass, depth = std::max(0.0, depth_of_box(o, size));
  return mass * g * o.X_WO.translation().z() + 0.5 * mass * o.V_WO_W.linear.squaredNorm() +
         0.5 * w.dot(body.mass_properties.inertia_O * w) + (depth > 0.0 ? 0.5 * stiffness * depth * depth : 0.0);
}

TEST_P(Compliant, GainsNoEnergy) {
  test_support::Random random(3);
  const Vector3d size(0.1, 0.06, 0.04);
  for (int i = 0; i < 24; ++i) {
    const double mass = std::pow(10.0, random.number(-1.0, 1.0)), k = std::pow(10.0, random.number(3.0, 6.0));
    scene::Body body = with_stiffness(box("body", size, mass, Vector3d(0, 0, random.number(0.06, 0.11))), k);
    body.X_WO.linear() = random.rotation();
    scene::Scene scene = scene_of({body}, GetParam(), random.number(0.0, 1.0));
    add_neighbour(scene, Vector3d(0.0, 0.0625 + 0.025, 0.06));
    for (scene::Body& b : scene.bodies) b.material = body.material;
    scene.bench_material.restitution = i % 2 == 0 ? 0.0 : random.number(0.0, 1.0);
    for (scene::Body& b : scene.bodies) b.material.restitution = scene.bench_material.restitution;
    SimulationSettings set;
    set.dynamics.step = std::vector<double>{0.02, 5e-3, 1e-3}[static_cast<std::size_t>(i) % 3];
    Simulation s(scene, set);
    s.advance_to(0.0);
    const auto energy = [&] {
      double sum = energy_of(object(s, "body"), scene.bodies[0], size, k);
      if (scene.bodies.size() > 1)
        sum += energy_of(object(s, "neighbour"), scene.bodies[1], Vector3d::Constant(0.05), k);
      return sum;
    };
    const double start = energy();
    double least = start;
    for (double t = set.dynamics.step; t < 1.5; t += set.dynamics.step) {
      s.advance_to(t);
      EXPECT_LT(energy(), least + 2e-3 * start) << i << " " << t << " " << mass << " " << k;
      least = std::min(least, energy());
    }
  }
}

/// An impact is over at once: it knows restitution, and no stiffness.
TEST_P(Compliant, BouncesAsARigidBodyDoes) {
  constexpr double radius = 0.05, drop = 0.2, e = 0.7;
  for (const double stiffness : {2e3, 1e5, std::numeric_limits<double>::infinity()}) {
    scene::Body ball = with_stiffness(box("ball", Vector3d::Ones(), 1.0, Vector3d(0, 0, radius + drop)), stiffness);
    ball.mass_properties.inertia_O = 0.4 * radius * radius * Matrix3d::Identity();
    ball.collision[0].geometry = geometry::Sphere{radius};
    ball.material.restitution = e;
    scene::Scene scene = scene_of({ball}, GetParam());
    scene.bench_material.restitution = e;
    add_neighbour(scene, Vector3d(0.0, radius + 1.5e-3 + 0.025, 0.025));
    Simulation s(scene, SimulationSettings());
    s.advance_to(0.0);
    const double fall = std::sqrt(2.0 * drop / g);
    s.advance_to(fall * (1.0 + e));
    EXPECT_NEAR(object(s, "ball").X_WO.translation().z() - radius, e * e * drop, 0.02 * e * e * drop) << stiffness;
  }
}

/// Between the rigid limit and one that hardly carries.
TEST_P(Compliant, AsStiffAsCanBeItIsRigid) {
  const auto run = [&](double stiffness) {
    scene::Scene scene = scene_of({box("held", Vector3d(0.1, 0.06, 0.04), 0.5, Vector3d(0, 0, 0.05)),
                                   box("wall", Vector3d(0.02, 1.0, 1.0), 0.0, Vector3d(0.12, 0, 0.5))},
                                  GetParam());
    for (scene::Body& body : scene.bodies) body.material.stiffness = stiffness;
    add_neighbour(scene, Vector3d(0.0, 0.08, 0.025));
    SimulationSettings set;
    set.grasp.object = "held";
    Simulation s(scene, set);
    const Vector3d start(0, 0, 0.05 + set.fork.length);
    push_move(s, 0.0, 1.0, start, start + Vector3d(0.1, 0.0, -0.05), 0.2);
    for (double t = 1.02; t < 3.0; t += 0.02) s.push_stylus({t, pointing_down(start + Vector3d(0.1, 0.0, -0.05), 0.2)});
    s.push_button(0.0, true);
    EXPECT_EQ(s.advance_to(2.9).steps_blocked, 0) << stiffness;
    return s.objects()[0].X_WO;
  };
  const RigidTransform rigid = run(std::numeric_limits<double>::infinity());
  for (const double stiffness : {1e8, 1e12}) {
    EXPECT_LT((run(stiffness).matrix() - rigid.matrix()).norm(), 5e-5) << stiffness;
  }
}

/// Its tip yields with the probe, its foot with the bench.
TEST_P(Compliant, AProbePressesAnObjectThatYieldsAtEachOfItsContactsOnce) {
  constexpr double own = 2e4, bench = 5e3, probe = 3e3, mass = 1.0, tip = 0.09;
  scene::Scene scene =
      scene_of({with_stiffness(box("box", Vector3d(0.1, 0.1, 0.1), mass, Vector3d(0, 0, 0.05)), own)}, GetParam());
  scene.bench_material.stiffness = bench;
  add_neighbour(scene, Vector3d(0.0, 0.051 + 0.025, 0.025));
  SimulationSettings set;
  set.tool = tools::Tool::spring_probe;
  set.fork.stiffness.stretch = probe;
  Simulation s(scene, set);
  const Vector3d high(0.01, 0.01, set.fork.length + 0.12), low(0.01, 0.01, set.fork.length + tip);
  push_move(s, 0.0, 1.0, high, low);
  push_move(s, 1.02, 3.0, low, low);
  s.advance_to(2.9);
  const double foot = 1.0 / own + 1.0 / bench, at_tip = 1.0 / own + 1.0 / probe;
  const double force = (0.1 - mass * g * foot - tip) / (at_tip + foot);
  EXPECT_NEAR(s.tool().tip_wrench_W.force.z(), -force, 5e-3 * force);
  EXPECT_NEAR(0.05 - s.objects()[0].X_WO.translation().z(), (mass * g + force) * foot, 1e-2 * force * foot);
}

/// What is deep in one body may not be so in another.
TEST_P(Compliant, DeepInASoftBenchItStillStopsAtARigidWall) {
  constexpr double bench = 3e3, wall = 0.2;
  scene::Scene scene = scene_of({box("held", Vector3d(0.1, 0.06, 0.04), 0.5, Vector3d(0, 0, 0.05)),
                                 box("wall", Vector3d(1e-3, 1.0, 1.0), 0.0, Vector3d(wall + 5e-4, 0, 0.3))},
                                GetParam(), 0.1);
  scene.bench_material.stiffness = bench;
  add_neighbour(scene, Vector3d(0.0, 0.08, 0.025));
  SimulationSettings set;
  set.grasp.object = "held";
  Simulation s(scene, set);
  const Vector3d start(0, 0, 0.05 + set.fork.length), down = start - Vector3d(0, 0, 0.08);
  push_move(s, 0.0, 1.0, start, down);
  push_move(s, 1.02, 1.6, down, down + Vector3d(0.3, 0.0, 0.0));
  s.push_button(0.0, true);
  double deepest = 0.0, furthest = 0.0;
  for (double t = 0.02; t < 1.59; t += 0.02) {
    EXPECT_EQ(s.advance_to(t).steps_blocked, 0) << t;
    const bodies::BodyState& o = s.objects()[0];
    const double half = 0.5 * o.X_WO.linear().row(0).cwiseAbs().dot(Vector3d(0.1, 0.06, 0.04));
    furthest = std::max(furthest, o.X_WO.translation().x() + half - wall);
    deepest = std::max(deepest, depth_of_box(o, Vector3d(0.1, 0.06, 0.04)));
  }
  EXPECT_GT(deepest, 2e-3);
  EXPECT_GT(furthest, -1e-3);
  EXPECT_LT(furthest, 1e-4);
}

}  // namespace
}  // namespace spring_workbench::simulation::compliant_contact_test
