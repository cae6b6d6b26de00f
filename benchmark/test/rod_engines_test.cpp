// The rod's law as a force, and engines that are given it.
#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <random>
#include <set>
#include <sstream>
#include <utility>

#include "benchmark/baselines.h"
#include "benchmark/rod_reference.h"
#include "benchmark/rod_table.h"
#include "case_called.h"
#include "spring_workbench/math/so3.h"

namespace spring_workbench::benchmark::rod_engines_test {
namespace {

using When = RodForce::When;

const std::vector<RodEngine>& engines() {
  static const Baselines instance = all_baselines();
  return instance.rods;
}

bool is_rk4(const RodEngine& engine) { return engine.when == When::each_stage; }

BodyState body_at(const motion::MotionState& O) {
  return {O.X.translation(), Quaterniond(O.X.linear()), O.velocity.linear,
          O.X.linear().transpose() * O.velocity.angular};
}

TEST(RodForce, ABodyUnderItHasTheAccelerationOfTheEquationOfMotion) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> share(-0.3, 0.3);
  for (const std::string name : {"soft_6dof", "stiff_6dof", "heavy_large_bend"}) {
    const RodCase one = case_called(name, 1.0);
    for (const std::string shape : {"linear", "bushing"}) {
      const dynamics::HeldBody held = held_body(one, shape);
      const SampledHand hand(one.hand, one.fork.length);
      for (int i = 0; i < 20; ++i) {
        RodForce force(one, shape, When::each_stage);
        const double t = 0.04 * i + 0.013;
        dynamics::StrainState state = held.zero_state();
        for (int k = 0; k < 6; ++k) state.q[k] = share(random) * held.units()[k];
        for (int k = 0; k < 6; ++k) state.q_dot[k] = 10.0 * share(random) * held.units()[k];
        const dynamics::HandleState handle = held.state_at(hand.handle(t), t);
        const rod::StrainVector q_ddot = held.acceleration(handle, state.q, state.q_dot);
        const motion::MotionState O = held.object(handle, state, &q_ddot);
        const BodyState body = body_at(O);
        const Wrench load = force.load(t, 1e-3, body);
        EXPECT_FALSE(force.lost());
        const Vector3d a = load.force / one.mass - 9.81 * Vector3d::UnitZ();
        const Vector3d I = one.inertia, w = body.w_WO_O;
        const Vector3d moment_O = body.R_WO.conjugate() * load.moment;
        const Vector3d alpha = body.R_WO * Vector3d((moment_O - w.cross(I.cwiseProduct(w))).cwiseQuotient(I));
        EXPECT_LT((a - O.acceleration.linear).norm(), 1e-8 * O.acceleration.linear.norm()) << name << shape;
        EXPECT_LT((alpha - O.acceleration.angular).norm(), 1e-8 * O.acceleration.angular.norm()) << name << shape;
      }
    }
  }
}

TEST(RodForce, OfTheEndOfAStepIsThatOfSpringAndDamperThere) {
  // A single spring along the fork, of any stiffness, on a hand that moves along it: implicit Euler.
  for (const double stiffness : {3e2, 1e6, 1e12}) {
    RodCase one = case_called("soft_6dof", 1.0);
    one.p_OE.head<2>().setZero();
    one.fork.stiffness.stretch = stiffness;
    const double h = 0.02, c = held_body(one, "linear").dof_damping().stretch;
    const auto hand = [](double t) { return 0.05 * std::sin(10.0 * t); };
    for (motion::PoseSample& sample : one.hand)
      sample.X = make_transform(hand(sample.t) * Vector3d::UnitZ(), Quaterniond::Identity());
    RodForce force(one, "linear", When::end_of_step);
    BodyState body = force.body().start;
    const double rest = body.p_WO.z();
    double extension = 0.0;
    for (int i = 0; i < 20; ++i) {
      const Wrench load = force.load(i * h, h, body);
      body.v_WO_W += h * (load.force / one.mass - 9.81 * Vector3d::UnitZ());
      body.p_WO += h * body.v_WO_W;
      const double before = std::exchange(extension, body.p_WO.z() - rest - hand((i + 1) * h));
      const double there = -stiffness * extension - c * (extension - before) / h;
      EXPECT_NEAR(load.force.z(), there, 1e-3 * one.mass * 9.81) << stiffness << ' ' << i;
      EXPECT_LT(load.force.head<2>().norm() + load.moment.norm(), 1e-6) << stiffness;
    }
    EXPECT_FALSE(force.lost());
  }
}

TEST(RodForce, OfTheEndOfAStepIsTheLawAtTheStateThatItLeadsTo) {
  std::mt19937 random(6);
  std::uniform_real_distribution<double> share(-1e-4, 1e-4);
  for (const double stiffness : {1.0, 1e3, 1e6}) {
    RodCase one = case_called("soft_6dof", 1.0);
    one.fork.stiffness = {stiffness * one.fork.stiffness.stretch, stiffness * one.fork.stiffness.bend,
                          stiffness * one.fork.stiffness.torsion};
    for (motion::PoseSample& sample : one.hand) sample.X = one.hand[0].X;
    const dynamics::HeldBody held = held_body(one, "linear");
    const SampledHand hand(one.hand, one.fork.length);
    for (int i = 0; i < 10; ++i) {
      dynamics::StrainState state = held.zero_state();
      for (int k = 0; k < 6; ++k) state.q[k] = share(random) * held.units()[k];
      BodyState body = body_at(held.object(held.state_at(hand.handle(0.0), 0.0), state));
      const double h = 0.05 / std::sqrt(stiffness);
      body.v_WO_W = h * 9.81 * Vector3d::UnitZ();  // the law is linearised where the body would be without it
      const Wrench load = RodForce(one, "linear", When::end_of_step).load(0.0, h, body);
      body.v_WO_W += h * (load.force / one.mass - 9.81 * Vector3d::UnitZ());
      body.w_WO_O += h * Vector3d((body.R_WO.conjugate() * load.moment).cwiseQuotient(one.inertia));
      body.p_WO += h * body.v_WO_W;
      body.R_WO = body.R_WO * Quaterniond(math::exp_so3(h * body.w_WO_O));
      const Wrench there = RodForce(one, "linear", When::each_stage).load(h, h, body);
      EXPECT_LT((there.force - load.force).norm(), 0.01 * load.force.norm()) << stiffness << ' ' << i;
      EXPECT_LT((there.moment - load.moment).norm(), 0.01 * load.moment.norm()) << stiffness << ' ' << i;
    }
  }
}

TEST(RodForce, WhereTheRodDoesNotReachThereIsNoneFromThenOn) {
  const RodCase one = case_called("soft_6dof", 1.0);
  RodForce force(one, "linear", When::start_of_step);
  BodyState far = force.body().start;
  far.p_WO = one.hand[0].X * Vector3d(Vector3d(0.0, 0.0, -0.1) - one.p_OE);  // its tip behind the handle
  const BodyState start = force.body().start;
  EXPECT_LT(force.load(0.0, 1e-3, start).force.norm(), 1e-6);
  EXPECT_FALSE(force.lost());
  force.load(0.0, 1e-3, far);
  EXPECT_TRUE(force.lost());
  EXPECT_EQ(force.load(0.0, 1e-3, start).force.norm(), 0.0);
}

TEST(RodEngines, EachThatIsFoundHasAForceOfTheStartAndOfTheEndOfTheStep) {
  const Baselines baselines = all_baselines();
  EXPECT_EQ(std::count_if(engines().begin(), engines().end(), [](const RodEngine& e) { return !is_rk4(e); }),
            2 * (static_cast<long>(baselines.found.size()) - 1));  // SUNDIALS is none
  std::set<std::string> names;
  for (const RodEngine& engine : engines()) names.insert(engine.name);
  EXPECT_EQ(names.size(), engines().size());
}

TEST(RodEngines, ComeToTheReferenceWithTheirOrder) {
  for (const std::string name : {"soft_6dof", "heavy_large_bend"}) {
    const RodCase one = case_called(name, 0.5);
    const RodReference reference = rod_reference(one, "linear");
    for (const RodEngine& engine : engines()) {
      const auto error = [&](int steps) {
        const RodRun run = run_engine(one, "linear", engine, 0.02 / steps);
        EXPECT_TRUE(run.finite) << engine.name;
        return largest_distance(run.X_WO, reference.X_WO);
      };
      const PoseDistance coarse = error(64), fine = error(128);
      // MuJoCo advances the rotation by the mean of the stages' angular velocities, which do not commute.
      const double order = is_rk4(engine) ? 2.0 : 1.0;
      EXPECT_LT(coarse.position, 0.1 * reference.largest_deflection) << engine.name << ' ' << name;
      EXPECT_NEAR(std::log2(coarse.position / fine.position), order, 0.15) << engine.name << ' ' << name;
      EXPECT_NEAR(std::log2(coarse.angle / fine.angle), order, 0.15) << engine.name << ' ' << name;
    }
  }
}

/// The case with the hand and the fork in a plane, where rotations commute: MuJoCo's mean of the stages' angular
/// velocities costs no order there.
RodCase in_plane(RodCase one) {
  one.p_OE.y() = 0.0;
  for (motion::PoseSample& sample : one.hand) {
    const Vector3d p(0.05 * std::sin(10.0 * sample.t), 0.0, 0.03 * std::sin(7.0 * sample.t));
    sample.X = make_transform(p, Quaterniond(math::exp_so3(0.2 * std::sin(8.0 * sample.t) * Vector3d::UnitY())));
  }
  return one;
}

TEST(RodEngines, InAPlaneTheRungeKuttaMethodIsOfFourthOrder) {
  const RodCase one = in_plane(case_called("soft_6dof", 0.5));
  const RodReference reference = rod_reference(one, "linear");
  for (const RodEngine& engine : engines()) {
    if (!is_rk4(engine)) continue;
    const auto error = [&](int steps) {
      return largest_distance(run_engine(one, "linear", engine, 0.02 / steps).X_WO, reference.X_WO);
    };
    const PoseDistance coarse = error(32), fine = error(64);
    EXPECT_NEAR(std::log2(coarse.position / fine.position), 4.0, 0.3);
    EXPECT_NEAR(std::log2(coarse.angle / fine.angle), 4.0, 0.3);
  }
}

/// The fastest frequency of small motions of the unstrained fork [rad/s].
double fastest_frequency(const RodCase& one) {
  const dynamics::HeldBody held = held_body(one, "linear");
  const Matrix6d K = held.stiffness().asDiagonal(), M = held.mass_matrix(0.0, held.zero_state().q);
  return std::sqrt(Eigen::GeneralizedSelfAdjointEigenSolver<Matrix6d>(K, M).eigenvalues().maxCoeff());
}

TEST(RodEngines, WithoutDampersAnExplicitForceHoldsBelowTheStabilityLimitOfItsMethodAndIsLostAboveIt) {
  RodCase one = case_called("soft_light", 0.3);
  one.fork.damping_ratio = {0.0, 0.0, 0.0};
  for (motion::PoseSample& sample : one.hand) sample.X = RigidTransform::Identity();
  const double deflection = rod_reference(one, "linear").largest_deflection;
  const Vector3d rest = RodForce(one, "linear", When::start_of_step).body().start.p_WO;
  for (const RodEngine& engine : engines()) {
    if (engine.when == When::end_of_step) continue;
    const double limit = (is_rk4(engine) ? std::sqrt(8.0) : 2.0) / fastest_frequency(one);
    const RodRun below = run_engine(one, "linear", engine, 0.8 * limit),
                 above = run_engine(one, "linear", engine, 0.02 / std::floor(0.02 / (1.25 * limit)));
    EXPECT_TRUE(below.finite) << engine.name;
    EXPECT_FALSE(above.finite) << engine.name;
    double largest = 0.0;
    for (const RigidTransform& X : below.X_WO) largest = std::max(largest, (X.translation() - rest).norm());
    EXPECT_LT(largest, 1.5 * deflection) << engine.name;
    if (!is_rk4(engine)) {
      EXPECT_GT(largest, 0.8 * deflection) << engine.name;
    }
  }
}

TEST(RodEngines, AForceOfTheEndOfTheStepHoldsAStiffForkAtEveryStepAndAnExplicitOneIsLost) {
  for (const std::string name : {"stiff", "stiff_light"}) {
    const RodCase one = case_called(name, 0.5);
    const RodReference reference = rod_reference(one, "linear");
    for (const RodEngine& engine : engines()) {
      const auto error = [&](int steps) {
        const RodRun run = run_engine(one, "linear", engine, 0.02 / steps);
        return run.finite ? largest_distance(run.X_WO, reference.X_WO).position : 1e300;
      };
      if (engine.when != When::end_of_step) {
        EXPECT_EQ(error(4), 1e300) << engine.name << ' ' << name;
        continue;
      }
      double before = 1e300;
      for (const int steps : {1, 4, 16, 64}) {
        const double now = error(steps);
        EXPECT_LT(now, 0.01) << engine.name << ' ' << name << ' ' << steps;
        EXPECT_LT(now, before) << engine.name << ' ' << name << ' ' << steps;
        before = now;
      }
    }
  }
}

TEST(RodEngines, HaveTheirLinesInTheTableWhereNoDofIsOffAndWhatIsLostIsARow) {
  RodTablePlan plan = rod_table_plan(true, "");
  plan.cases = {case_called("stiff", 0.1), case_called("bend_only", 0.1), case_called("soft_6dof", 0.1)};
  for (RodCase& one : plan.cases) one.shapes = {"linear"};
  plan.cases[2].shapes = {"constant"};  // four coordinates
  plan.steps_per_output = {1, 4};
  plan.tolerances.clear();
  plan.baseline_tolerances = {1e-3};
  plan.longest_run = plan.longest_engine_run = std::numeric_limits<double>::infinity();
  plan.tolerance_time_limit = 60.0;
  plan.repetition = {};
  std::ostringstream log;
  Progress progress(log, false, unit_count(plan));
  Units units(progress, Shard{});
  std::map<std::string, int> rows, finite;
  for (const ErrorRow& row : rod_table(plan, engines(), units)) {
    if (std::none_of(engines().begin(), engines().end(), [&](const RodEngine& e) { return e.name == row.method; }))
      continue;
    EXPECT_EQ(row.scene, "stiff");
    EXPECT_FALSE(row.ours);
    EXPECT_FALSE(row.own_reference);
    ++rows[row.method];
    finite[row.method] += row.finite;
  }
  EXPECT_EQ(rows.size(), engines().size());
  for (const RodEngine& engine : engines()) {
    EXPECT_GE(rows[engine.name], 2) << engine.name;  // more where its line begins between the two
    EXPECT_EQ(finite[engine.name], engine.when == When::end_of_step ? rows[engine.name] : 0) << engine.name;
  }
}

}  // namespace
}  // namespace spring_workbench::benchmark::rod_engines_test
