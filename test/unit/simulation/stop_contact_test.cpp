// Contact mode `stop` against statics and geometry.
#include <gtest/gtest.h>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <utility>

#include "spring_workbench/rod/shape_model.h"
#include "spring_workbench/simulation/simulation.h"
#include "support/bench_scenes.h"
#include "support/named.h"

namespace spring_workbench::simulation::stop_contact_test {
namespace {

using spring_workbench::scene_of;  // beside the one below

constexpr double length = 0.2;

scene::Scene scene_of(std::vector<scene::Body> bodies, double friction = 0.5) {
  return spring_workbench::scene_of(std::move(bodies), scene::ContactMode::stop, friction);
}

/// A rod clamped at both ends with its tip shifted sideways and guided: force [N], deflection and shortening [m].
struct SShape {
  double force, deflection, shortening;
};

/// The static answer of a shape model: K q = Jᵀ (P, M), with M such that the tip does not turn, by Newton with
/// differences.
SShape own_figure(const std::string& name, double bend, double force) {
  const rod::PerDof k{1e10, bend, 1e10};  // neither extension nor twist
  const auto made = rod::make_shape_model(test_support::shape_named(name), length);
  const rod::ShapeModel& shape = *made;
  const rod::StrainVector K = shape.stiffness(k), none = rod::StrainVector::Zero(shape.size());
  rod::TipKinematics tip;
  const int n = shape.size();
  Eigen::VectorXd x = Eigen::VectorXd::Zero(n + 1);  // strain, moment
  for (int stage = 1; stage <= 20; ++stage) {
    const auto residual = [&](const Eigen::VectorXd& at) {
      const rod::StrainVector q = at.head(n);
      shape.tip(q, none, tip);
      const rod::StrainVector r = K.cwiseProduct(q) -
                                  tip.linear.transpose() * Vector3d(force * stage / 20.0, 0.0, 0.0) -
                                  tip.angular.transpose() * (tip.R_HE.transpose() * Vector3d(0.0, at[n], 0.0));
      Eigen::VectorXd all(n + 1);
      all << r, tip.R_HE(0, 2);
      return all;
    };
    for (int newton = 0; newton < 20; ++newton) {
      Eigen::MatrixXd slope(n + 1, n + 1);
      for (int j = 0; j <= n; ++j) {
        Eigen::VectorXd up = x, down = x;
        const double step = j == n ? 1e-5 : 1e-5 * K[0] / std::max(K[0], K[j]);
        up[j] += step;
        down[j] -= step;
        slope.col(j) = (residual(up) - residual(down)) / (2.0 * step);
      }
      x -= slope.partialPivLu().solve(residual(x));
    }
  }
  shape.tip(rod::StrainVector(x.head(n)), none, tip);
  return {force, tip.p_HE.x(), length - tip.p_HE.z()};
}

/// A box held flush on the bench by its middle, and the hand shifted sideways and lowered.
struct Shifted {
  double sideways, axial;  // force of the rod on the box [N]
  double slope;            // of the box [rad]
  double slid;             // [m]
};

Shifted shift(double bend, double sideways, double lowered) {
  scene::Scene scene = scene_of({box("box", Vector3d(0.2, 0.2, 0.04), 5.0, Vector3d(0, 0, 0.02), 1.0)}, 1.0);
  SimulationSettings set;
  set.fork.length = length;
  set.fork.stiffness = {1e5, bend, 10.0};
  set.grasp.object = "box";
  Simulation s(scene, set);
  const Vector3d start(0, 0, 0.02 + length), end(sideways, 0, 0.02 + length - lowered);
  push_move(s, 0.0, 0.4, start, end);
  push_move(s, 0.42, 0.8, end, end);
  s.advance_to(0.8);
  const RigidTransform& X = s.objects()[0].X_WO;
  const Wrench& tip = s.tool().tip_wrench_W;
  return {tip.force.x(), tip.force.z(), std::acos(std::min(1.0, X.linear()(2, 2))),
          (X.translation() - Vector3d(0, 0, 0.02)).norm()};
}

TEST(StopContact, FlushAndShiftedItBendsTheForkInSShape) {
  // Clamped and guided, the exact elastica is two cantilevers at a quarter of the load (doc/model.md, checked figures).
  struct Exact {
    double alpha, deflection, shortening;
  };
  for (const Exact exact : {Exact{0.4, 0.03329531927, 0.000665399963}, Exact{4.0, 0.3017207738, 0.05643323628}}) {
    constexpr double bend = 50.0, EI = bend * length * length * length / 3.0;
    const double force = exact.alpha * EI / (length * length);
    const SShape own = own_figure("linear", bend, force);
    EXPECT_NEAR(own.deflection / length, exact.deflection, 2e-3 * exact.deflection);
    EXPECT_NEAR(own.shortening / length, exact.shortening, 1e-2 * exact.shortening);
    // The height at which the rod exerts no axial force, by the secant method.
    double z0 = 0.98 * own.shortening, z1 = 1.02 * own.shortening;
    double f0 = shift(bend, own.deflection, z0).axial;
    Shifted there = shift(bend, own.deflection, z1);
    for (int i = 0; i < 3 && std::abs(there.axial) > 1e-4 * force; ++i) {
      const double z2 = z1 - there.axial * (z1 - z0) / (there.axial - f0);
      z0 = std::exchange(z1, z2);
      f0 = std::exchange(there, shift(bend, own.deflection, z1)).axial;
    }
    EXPECT_LT(there.slope, 1e-6) << exact.alpha;
    EXPECT_LT(there.slid, 2e-6) << exact.alpha;
    EXPECT_LT(std::abs(there.axial), 1e-3 * force) << exact.alpha;
    EXPECT_NEAR(there.sideways, force, 1e-3 * force) << exact.alpha;
    // The slightly extensible rod is as accurate as its shape model.
    EXPECT_NEAR(z1 / length, exact.shortening, 1e-6 + std::abs(own.shortening / length - exact.shortening))
        << exact.alpha;
  }
}

/// How deep a box's corners are below z = 0 or above `ceiling` [m].
double outside(const RigidTransform& X, const Vector3d& size, double ceiling) {
  const double reach = 0.5 * X.linear().row(2).cwiseAbs().dot(size);
  return std::max(reach - X.translation().z(), X.translation().z() + reach - ceiling);
}

TEST(StopContact, BetweenTwoSurfacesItSlidesAndStaysOutOfBoth) {
  const Vector3d size(0.1, 0.1, 0.1);
  for (const double room : {0.0, 1e-4, 2e-3}) {
    for (const double k : {500.0, 5e4}) {
      const double ceiling = size.z() + room;
      scene::Scene scene = scene_of({box("box", size, 1.0, Vector3d(0, 0, 0.05), 0.2),
                                     box("ceiling", Vector3d(2.0, 2.0, 0.1), 0.0, Vector3d(0, 0, ceiling + 0.05), 0.2)},
                                    0.2);
      SimulationSettings set;
      set.fork.length = length;
      set.fork.stiffness = {k, k, 0.01 * k};
      set.grasp.object = "box";
      Simulation s(scene, set);
      const Vector3d start(0, 0, 0.05 + length);
      push_move(s, 0.0, 0.4, start, start + Vector3d(0.1, 0, 0.03));
      push_move(s, 0.42, 0.8, start + Vector3d(0.1, 0, 0.03), start + Vector3d(0.3, 0.1, -0.03), 0.5);
      push_move(s, 0.82, 1.2, start + Vector3d(0.3, 0.1, -0.03), start + Vector3d(0.3, 0.1, 0.0), 0.0);
      double deepest = 0.0;
      int steps_blocked = 0;
      for (double t = 0.0; t < 1.2 + 1e-9; t += 0.005) {
        steps_blocked += s.advance_to(t).steps_blocked;
        deepest = std::max(deepest, outside(s.objects()[0].X_WO, size, ceiling));
      }
      EXPECT_LT(deepest, 1e-5) << room << " " << k;
      EXPECT_EQ(steps_blocked, 0) << room << " " << k;
      EXPECT_LT((s.objects()[0].X_WO.translation() - Vector3d(0.3, 0.1, 0.05)).norm(), 1e-3 + room) << room << " " << k;
    }
  }
}

/// A hand presses a box onto the bench along a rigid direction, and shifts it sideways within friction.
TEST(StopContact, AForkThatCannotFollowPressesByItsRuleAndBlocksNothing) {
  constexpr double pressed = 2e-3, T = 5e-3;  // m, s: doc/model.md
  for (const rod::ForkDofs dofs :
       {rod::ForkDofs{false, false, false}, rod::ForkDofs{false, true, false}, rod::ForkDofs{false, true, true}}) {
    for (const double mass : {0.1, 5.0}) {
      for (const double step : {0.02, 0.004}) {
        SimulationSettings set;
        set.dynamics.step = step;
        set.fork.length = length;
        set.fork.stiffness = {1e5, 50.0 * mass, 10.0};
        set.fork.dofs = dofs;
        set.grasp.object = "box";
        Simulation s(scene_of({box("box", Vector3d(0.2, 0.2, 0.04), mass, Vector3d(0, 0, 0.02), 1.0)}, 1.0), set);
        const Vector3d start(0, 0, 0.02 + length), low = start - pressed * Vector3d::UnitZ();
        const Vector3d aside = low + Vector3d(dofs.bend ? 5e-3 : 0.0, 0, 0);
        push_move(s, 0.0, 0.4, start, low);
        push_move(s, 0.42, 0.8, low, aside);
        push_move(s, 0.82, 3.0, aside, aside);
        EXPECT_EQ(s.advance_to(0.4).steps_blocked, 0);
        double force = 0.0;
        for (const contact::ContactState& c : s.contacts()) force += c.force;
        EXPECT_NEAR(force, mass * pressed / (T * T), 0.05 * force)
            << dofs.bend << dofs.torsion << " " << mass << " " << step;
        EXPECT_EQ(s.advance_to(1.0).steps_blocked, 0);
        const Vector3d p = s.objects()[0].X_WO.translation();
        EXPECT_EQ(s.advance_to(3.0).steps_blocked, 0);
        EXPECT_LT((p - Vector3d(0, 0, 0.02)).norm(), 1e-5);
        EXPECT_LT((s.objects()[0].X_WO.translation() - p).norm(), 1e-6) << "creeps";
      }
    }
  }
}

TEST(StopContact, APegGoesIntoAHoleWithAMillimetreToSpareWithoutRattling) {
  // A peg of 20 mm in a square hole of 21 mm; the hand is off by 0.4 mm at first and by 3 mm when the peg is in.
  constexpr double hole = 0.021, depth = 0.04, wall = 0.05;
  const Vector3d peg(0.02, 0.02, 0.06);
  std::vector<scene::Body> bodies{box("peg", peg, 0.1, Vector3d(0.0004, 0, depth + 0.05), 0.2)};
  for (const double side : {-1.0, 1.0}) {
    bodies.push_back(box("x" + std::to_string(side), Vector3d(wall, 0.2, depth), 0.0,
                         Vector3d(side * 0.5 * (hole + wall), 0, 0.5 * depth), 0.2));
    bodies.push_back(box("y" + std::to_string(side), Vector3d(hole, wall, depth), 0.0,
                         Vector3d(0, side * 0.5 * (hole + wall), 0.5 * depth), 0.2));
  }
  SimulationSettings set;
  set.fork.length = length;
  set.fork.stiffness = {2000.0, 500.0, 5.0};
  set.grasp.object = "peg";
  Simulation s(scene_of(bodies, 0.2), set);
  const Vector3d above(0.0004, 0, depth + 0.05 + length), entered(0.0004, 0, depth + 0.02 + length);
  const Vector3d pressed(0.003, 0, depth + 0.02 + length), in(0.003, 0, 0.035 + length);
  push_move(s, 0.0, 1.0, above, entered);
  push_move(s, 1.02, 2.0, entered, pressed);
  push_move(s, 2.02, 4.0, pressed, in);
  push_move(s, 4.02, 4.5, in, in);
  std::vector<double> force;  // on the wall while the peg goes down along it
  for (double t = 0.0; t < 4.5 + 1e-9; t += 0.02) {
    EXPECT_EQ(s.advance_to(t).steps_blocked, 0) << t;
    if (t < 2.3 || t > 3.7) continue;
    force.push_back(0.0);
    for (const contact::ContactState& c : s.contacts()) force.back() += std::abs(c.n_W.x()) * c.force;
  }
  for (std::size_t i = 1; i + 1 < force.size(); ++i) {
    EXPECT_GT(force[i], 0.5) << i;
    EXPECT_NEAR(force[i], 0.5 * (force[i - 1] + force[i + 1]), 1e-3 * force[i]) << i;  // the ripple
  }
  EXPECT_NEAR(s.objects()[0].X_WO.translation().z(), 0.035, 1e-3);
}

/// Dropped flat from a height, it returns to e² of it, where e is the geometric mean of both restitutions.
TEST(StopContact, ADroppedBoxBouncesByItsRestitution) {
  constexpr double edge = 0.1, height = 0.3;
  for (const double of_box : {0.9, 0.4}) {
    scene::Body dropped = box("dropped", Vector3d::Constant(edge), 1.0, Vector3d(0.0, 0.0, 0.5 * edge));
    dropped.material.restitution = of_box;
    scene::Scene scene = scene_of({dropped}, scene::ContactMode::stop);
    scene.bench_material.restitution = 0.8;
    SimulationSettings settings;
    settings.dynamics.step = 1e-3;
    Simulation simulation(scene, settings);
    simulation.advance_to(0.0);
    simulation.place({{"dropped", make_transform(Vector3d(0.0, 0.0, 0.5 * edge + height), Quaterniond::Identity())}});
    double highest = 0.0;
    const double down = std::sqrt(2.0 * height / 9.81), e = std::sqrt(of_box * 0.8);
    for (double t = 0.0; t < down * (1.0 + 1.9 * e); t += 1e-3) {
      simulation.advance_to(t);
      if (t > 1.05 * down)
        highest = std::max(highest, object(simulation, "dropped").X_WO.translation().z() - 0.5 * edge);
    }
    EXPECT_NEAR(highest, e * e * height, 0.03 * height) << of_box;
  }
}

/// A bent and compressed fork that draws a box over a bench without friction: what its strain would store, the bench
/// holds against, so the estimate of the error in energy is that of the slow motion alone.
TEST(StopContact, TheErrorInEnergyKnowsTheWorkOfTheBench) {
  SimulationSettings set;
  set.fork.length = length;
  set.fork.stiffness = {500.0, 200.0, 2.0};
  Simulation simulation(scene_of({box("box", {0.1, 0.06, 0.04}, 1.0, Vector3d(0, 0, 0.02))}, 0.0), set);
  const Vector3d above(0.0, 0.0, 0.22), pressed = above + Vector3d(0.02, 0.0, -0.02);
  push_move(simulation, 0.0, 0.5, above, pressed);
  push_move(simulation, 1.0, 2.0, pressed, pressed + Vector3d(0.2, 0.0, 0.0));
  simulation.push_button(0.0, true);
  simulation.advance_to(0.98);
  const AdvanceReport report = simulation.advance_to(1.9);
  EXPECT_GT(simulation.tool().elastic_energy, 0.05);
  EXPECT_LT(report.energy_error, 2e-7);
  EXPECT_EQ(report.substeps, 0);
}

/// Lowered onto the bench, pressed by 100 N and moved along it without friction: short and long steps give the same
/// path, and nothing hovers.
TEST(StopContact, ShortStepsGoTheWayOfLongOnes) {
  const auto heights = [](double step) {
    SimulationSettings settings;
    settings.fork.stiffness = {2000.0, 2000.0, 20.0};
    settings.dynamics.step = step;
    settings.grasp.object = "box";
    Simulation simulation(
        scene_of({box("box", Vector3d(0.1, 0.06, 0.04), 1.0, Vector3d(0, 0, 0.03), 0.0)}, scene::ContactMode::stop),
        settings);
    const Vector3d above(0, 0, 0.03 + settings.fork.length);
    push_move(simulation, 0.0, 0.1, above, above + Vector3d(0.02, 0, -0.06));
    push_move(simulation, 0.12, 0.16, above + Vector3d(0.02, 0, -0.06), above + Vector3d(0.03, 0, -0.06));
    std::vector<double> z;
    for (int i = 1; i <= 7; ++i) {
      EXPECT_EQ(simulation.advance_to(0.02 * i).steps_blocked, 0) << step;
      z.push_back(object(simulation, "box").X_WO.translation().z());
    }
    return z;
  };
  const std::vector<double> long_steps = heights(0.02);
  EXPECT_NEAR(long_steps.back(), 0.02, 3e-6);
  for (const double step : {5e-3, 1e-3, 3e-4, 1e-4, 4e-5, 1e-5}) {
    const std::vector<double> z = heights(step);
    for (std::size_t i = 4; i < z.size(); ++i) EXPECT_NEAR(z[i], long_steps[i], 3e-5) << step << ' ' << i;
  }
}

}  // namespace
}  // namespace spring_workbench::simulation::stop_contact_test
