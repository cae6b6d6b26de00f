// The laws of the integrator `paper`: a relaxation to a target, three oscillators that nothing makes unstable.
#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

#include "spring_workbench/stepping/step_control.h"
#include "support/held_cases.h"
#include "support/named.h"

namespace spring_workbench::stepping::paper_test {
namespace {

using namespace dynamics;

std::unique_ptr<Integrator> paper() { return make_integrator(IntegratorKind::paper); }

StrainState carried(const Case& c, double t, double h, int steps, StrainState state) {
  const auto integrator = paper();
  for (int i = 0; i < steps; ++i) integrator->step(c.held, c.hand, t + i * h, h, state);
  return state;
}

/// Families by bits: stretch, bend, torsion.
StrainState switch_dofs(HeldBody& held, int families, double t = 0.0) {
  const rod::StrainVector zero = rod::StrainVector::Zero(held.shape().size());
  return held.set_dofs({(families & 1) != 0, (families & 2) != 0, (families & 4) != 0}, t, 0.05, {zero, zero});
}

TEST(Paper, ComesToTheRestOfTheEquationOfMotion) {
  // Off its centre and heavy: bent, stretched and twisted. The hand turned any way.
  std::mt19937 random(11);
  for (int trial = 0; trial < 40; ++trial) {
    const std::string shape =
        test_support::shape_names()[static_cast<std::size_t>(trial) % test_support::shape_names().size()];
    Case c = random_case(shape, 1.0, 1.0, random);
    StrainState state = switch_dofs(c.held, 1 + trial % 7);
    c.hand = motion::MotionSegment(c.hand.at(0.0).X);
    state = carried(c, 0.0, 0.05, 400, state);
    const rod::StrainVector a =
        c.held.acceleration(c.held.state_at(c.hand, 20.0), state.q, rod::StrainVector::Zero(state.q.size()));
    EXPECT_LT((c.held.object_jacobian(20.0, state.q) * a).norm(), 1e-7) << shape << " " << trial;
    EXPECT_LT(state.q_dot.norm(), 1e-9) << shape << " " << trial;
  }
}

TEST(Paper, IsOfOrderOneTowardsItsOwnLimit) {
  for (const std::string& shape : test_support::shape_names()) {
    for (const double zeta : {0.1, 1.0, 3.0}) {
      std::mt19937 random(5);
      const Case c = random_case(shape, zeta, 0.2, random);
      std::vector<StrainState> ends;
      for (const int steps : {64, 128, 256, 512})
        ends.push_back(carried(c, 0.0, 0.2 / steps, steps, c.held.zero_state()));
      const auto change = [&](std::size_t i) { return distance(c, 0.2, ends[i], ends[i + 1]); };
      for (const std::size_t i : {0u, 1u}) {
        EXPECT_NEAR(std::log2(change(i) / change(i + 1)), 1.0, 0.15) << shape << " " << zeta << " " << i;
      }
    }
  }
}

TEST(Paper, EstimatesTheDistanceFromItsOwnLimitWithinAFactorOfTenInNineStepsOfTen) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  int within = 0, all = 0;
  for (int trial = 0; trial < 60; ++trial) {
    const std::string shape =
        test_support::shape_names()[static_cast<std::size_t>(trial) % test_support::shape_names().size()];
    const Case c = random_case(shape, trial % 3 == 0 ? 0.1 : trial % 3 == 1 ? 1.0 : 3.0, 1.0, random);
    const double h = 1e-3 * std::pow(50.0, uniform(random));
    const auto integrator = paper();
    StrainState state = c.held.zero_state();
    for (int i = 0; i < 10; ++i) {
      const StrainState begin = state;
      const StepEstimate e = integrator->step(c.held, c.hand, i * h, h, state);
      const StrainState exact = carried(c, i * h, h / 50, 50, begin);
      const double t = (i + 1) * h, truth = distance(c, t, state, exact);
      const double ratio = distance(c, t, {exact.q + e.q_error, exact.q_dot}, exact) / truth;
      if (ratio > 0.1 && ratio < 10.0) ++within;
      ++all;
    }
  }
  EXPECT_GT(within, 0.9 * all) << within << " of " << all;
}

TEST(Paper, EnergyOfItsOscillatorsNeverGrowsWhereTheTargetStays) {
  // Hand at rest, deflection small: ½ Σ (μ q̇² + K (q − q*)²) with μ = K / ω², q* where it comes to rest.
  std::mt19937 random(3);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  for (int trial = 0; trial < 400; ++trial) {
    const double zeta = std::vector<double>{0.0, 0.01, 0.1, 1.0, 10.0}[static_cast<std::size_t>(trial) % 5];
    const double k = std::pow(10.0, 3.0 + 9.0 * uniform(random)), m = std::pow(10.0, 6.0 * uniform(random));
    const double h = 1e-3 * std::pow(50.0, 0.5 + 0.5 * uniform(random));
    BodyInertia body;
    body.mass = m;
    body.inertia_O = m * Vector3d(0.003, 0.0045, 0.004).asDiagonal();
    body.X_OE.translation() << 0.02, -0.01, -0.05;
    const std::string shape =
        test_support::shape_names()[static_cast<std::size_t>(trial) % test_support::shape_names().size()];
    HeldBody held(rod::make_shape_model(test_support::shape_named(shape), 0.2), body, 1e-6 * k / m);
    held.set_springs({k, k, 0.01 * k}, {zeta, zeta, zeta});
    const motion::MotionSegment rest(
        make_transform(Vector3d::Zero(), Quaterniond(math::exp_so3(Vector3d(1.0, 0.5, 0.0)))));
    StrainState at_rest = held.zero_state(), state = held.zero_state();
    HeldBody damped = held;
    damped.set_springs({k, k, 0.01 * k}, {1.0, 1.0, 1.0});
    const double slowest = std::sqrt(m / k);
    const auto to_rest = paper();
    for (int i = 0; i < 60; ++i) to_rest->step(damped, rest, 5.0 * slowest * i, 5.0 * slowest, at_rest);
    const auto integrator = paper();
    StrainState resting = at_rest;
    for (int i = 0; i < 5; ++i)
      integrator->step(held, rest, (i - 5) * h, h, resting);  // the target has come to its place
    for (int i = 0; i < state.q.size(); ++i) {
      state.q[i] = 1e-3 * uniform(random);
      state.q_dot[i] = 1e-3 * uniform(random) / slowest;
    }
    const rod::StrainVector K = held.stiffness();
    const rod::StrainVector units = held.shape().stiffness({m, m, held.axial_inertia()});
    const auto energy = [&] {
      const rod::StrainVector off = state.q - at_rest.q;
      return 0.5 * off.dot(K.cwiseProduct(off)) + 0.5 * state.q_dot.dot(units.cwiseProduct(state.q_dot));
    };
    const double start = energy();
    double last = start;
    for (int i = 0; i < 100; ++i) {
      integrator->step(held, rest, i * h, h, state);
      const double now = energy();
      ASSERT_LE(now, last + 1e-9 * start) << shape << " ζ " << zeta << " k " << k << " m " << m << " h " << h << " "
                                          << i << " gains " << (now - last) / start;
      last = now;
    }
    if (zeta == 0.0) {
      EXPECT_NEAR(last, start, 1e-7 * start);
    }
  }
}

enum class Hand { jump, flip, tremor, lissajous, dropout };

RigidTransform pose(Hand hand, double t, std::mt19937& random) {
  const Vector3d on_sines(0.15 * std::sin(6.3 * t), 0.15 * std::sin(8.2 * t + 1.0), 0.15 * std::sin(10.7 * t + 2.0));
  std::normal_distribution<double> normal;
  switch (hand) {
    case Hand::jump:
      return make_transform(Vector3d(t > 0.2 ? 1.0 : 0.0, 0.0, 0.0), Quaterniond::Identity());
    case Hand::flip:
      return make_transform(Vector3d::Zero(), Quaterniond(math::exp_so3(Vector3d(t > 0.2 ? M_PI : 0.0, 0.0, 0.0))));
    case Hand::tremor: {
      const Vector3d p(normal(random), normal(random), normal(random));
      return make_transform(1e-3 * p, Quaterniond::Identity());
    }
    case Hand::lissajous:
      return make_transform(
          on_sines, Quaterniond(math::exp_so3(Vector3d(0.6 * std::sin(5.0 * t), 0.6 * std::sin(7.0 * t), 0.0))));
    case Hand::dropout:
      return make_transform(t < 0.2 ? on_sines : Vector3d(0.1, 0.2, 0.3), Quaterniond::Identity());
  }
  return RigidTransform::Identity();
}

TEST(Paper, NoHandNoForkAndNoStepMakesItRejectOne) {
  std::mt19937 random(17);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  for (int trial = 0; trial < 105; ++trial) {
    const Hand hand = static_cast<Hand>(trial % 5);
    const double zeta = std::vector<double>{0.0, 0.01, 1.0, 10.0}[static_cast<std::size_t>(trial) % 4];
    const double k = trial % 2 == 0 ? std::pow(10.0, 3.0 + 9.0 * uniform(random)) : 500.0;
    const double m = trial % 2 == 0 ? std::pow(10.0, 6.0 * uniform(random)) : 1.0;
    const double step = 1e-3 * std::pow(50.0, 0.5 + 0.5 * uniform(random));
    BodyInertia body;
    body.mass = m;
    body.inertia_O = m / 12.0 * Vector3d(0.0125, 0.0425, 0.05).asDiagonal().toDenseMatrix();
    body.X_OE.translation() << 0.08, 0.0, 0.0;
    const std::string shape =
        test_support::shape_names()[static_cast<std::size_t>(trial) % test_support::shape_names().size()];
    HeldBody held(rod::make_shape_model(test_support::shape_named(shape), 0.2), body, 9.81);
    held.set_springs({4.0 * k, k, 0.01 * k}, {zeta, zeta, zeta});
    StrainState state = switch_dofs(held, 1 + trial % 7);
    motion::PoseTrack track;
    for (double t = 0.0; t < 0.61; t += 0.02) {
      if (hand == Hand::dropout && t > 0.2 && t < 0.45) continue;
      track.push({t, pose(hand, t, random)});
    }
    const StepControl control(paper());
    StepControl::Memory memory;
    for (double t = 0.0; t < 1.0;) {
      const motion::MotionSegment segment = track.segment(t + 1e-9);
      const double h = std::min(step, t < track.end() - 1e-9 ? segment.end() - t : 1.0);
      const ControlledStep done = control.advance(held, segment, t, h, state, memory);
      t += h;
      ASSERT_TRUE(done.accepted && done.fallback == 0 && done.substeps == 0 && done.steps == 1)
          << shape << " hand " << trial % 5 << " ζ " << zeta << " k " << k << " m " << m << " h " << step
          << " families " << 1 + trial % 7 << " at " << t;
      ASSERT_LT(held.object(held.state_at(segment, t), state).X.translation().norm(), 100.0);
    }
  }
}

TEST(Paper, EndsAtTheEndOfTheRodsRange) {
  // Far more weight than the fork can carry, on a fork that points up: compressed to nothing, or wound up.
  BodyInertia body;
  body.inertia_O = Vector3d(0.003, 0.0045, 0.004).asDiagonal();
  for (const bool torsion : {false, true}) {
    HeldBody held(rod::make_shape_model(rod::ShapeKind::linear, 0.2), body, 9.81);
    held.set_springs({1.0, 1.0, 1.0}, {0.1, 0.1, 0.1});
    StrainState state = switch_dofs(held, torsion ? 4 : 1);
    if (torsion) held.set_load({Vector3d::Zero(), Vector3d(0.0, 0.0, 100.0)});
    const motion::MotionSegment rest(RigidTransform::Identity());
    const StepControl control(paper());
    StepControl::Memory memory;
    int stops = 0;
    for (int i = 0; i < 400; ++i) stops += control.advance(held, rest, 0.05 * i, 0.05, state, memory).stops;
    EXPECT_GT(stops, 0);
    EXPECT_NEAR(state.q[0], torsion ? 64.0 / 0.2 : -0.98, 1e-6);
    EXPECT_TRUE(held.shape().admissible(held.full_state(20.0, state).q));
  }
}

TEST(Paper, SelectsTheFirstBodyInFront) {
  // A wall that the hanging object would sink through, and one that it does not reach.
  BodyInertia body;
  body.inertia_O = Vector3d(0.003, 0.0045, 0.004).asDiagonal();
  for (const double reaches : {0.3, 0.9, 1.1}) {
    HeldBody held(rod::make_shape_model(rod::ShapeKind::linear, 0.2), body, 9.81);
    held.set_springs({500.0, 500.0, 5.0}, {1.0, 1.0, 1.0});
    const motion::MotionSegment hanging(make_transform(Vector3d::Zero(), Quaterniond(0.0, 1.0, 0.0, 0.0)));
    const double sag = 9.81 / 500.0, floor = -0.2 - reaches * sag;
    int asked = 0;
    held.set_path_check([&](const RigidTransform&, const RigidTransform& X1_WO) {
      ++asked;
      return X1_WO.translation().z() > floor;
    });
    StrainState state = held.zero_state();
    const auto integrator = paper();
    const auto height = [&](double t) { return held.object(held.state_at(hanging, t), state).X.translation().z(); };
    int steps = 0;
    while (steps < 100 && height(0.02 * steps) > floor) integrator->step(held, hanging, 0.02 * steps++, 0.02, state);
    if (reaches > 1.0) {  // never there, and asked once a step
      EXPECT_NEAR(height(2.0), -0.2 - sag, 1e-6);
      EXPECT_EQ(asked, 100);
    } else {  // there, and no further than the last halving lets it; asked at each of them
      EXPECT_LT(steps, 100);
      EXPECT_NEAR(height(0.02 * steps), floor, sag / 64.0);
      EXPECT_GT(asked, 8 * (steps - 1));
    }
  }
}

TEST(Paper, WithoutStiffnessTheObjectIsFree) {
  BodyInertia body;
  body.mass = 3.0;
  body.inertia_O = Vector3d(0.003, 0.0045, 0.004).asDiagonal();
  for (const double k : {0.0, 1e-6}) {
    HeldBody held(rod::make_shape_model(rod::ShapeKind::linear, 0.2), body, 9.81);
    held.set_springs({k, 500.0, 5.0}, {1.0, 1.0, 1.0});
    StrainState state = switch_dofs(held, 1);
    const motion::MotionSegment hanging(make_transform(Vector3d::Zero(), Quaterniond(0.0, 1.0, 0.0, 0.0)));
    const auto integrator = paper();
    for (int i = 0; i < 10; ++i) integrator->step(held, hanging, 0.05 * i, 0.05, state);
    EXPECT_NEAR(held.shape().extension(held.full_state(0.5, state).q), 0.5 * 9.81 * 0.25, 1e-3 * (k > 0.0) + 1e-12);
  }
}

TEST(Paper, SaysHowItsStepRespondsToALoad) {
  std::mt19937 random(23);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  for (int trial = 0; trial < 28; ++trial) {
    const std::string shape =
        test_support::shape_names()[static_cast<std::size_t>(trial) % test_support::shape_names().size()];
    Case c = random_case(shape, 1.0, 0.2, random);
    c.hand = motion::MotionSegment(c.hand.at(0.0).X);
    StrainState begin = switch_dofs(c.held, 1 + trial % 7);
    const auto integrator = paper();
    for (int i = 0; i < 10; ++i) integrator->step(c.held, c.hand, 0.01 * i, 0.01, begin);
    const double h = 0.01;
    const Integrator::Response r = integrator->response(c.held, c.held.state_at(c.hand, 0.1), h, begin);
    const double size = 1e-4 * c.held.body().mass;
    const Wrench load{size * Vector3d(uniform(random), uniform(random), uniform(random)), Vector3d::Zero()};
    StrainState free = begin, loaded = begin;
    integrator->step(c.held, c.hand, 0.1, h, free);
    c.held.set_load(load);
    integrator->step(c.held, c.hand, 0.1, h, loaded);
    const auto R_HW = c.held.state_at(c.hand, 0.1 + h).X_WH.linear().transpose();
    const rod::StrainVector Q = c.held.object_jacobian(0.1 + h, begin.q).topRows<3>().transpose() * (R_HW * load.force);
    const rod::StrainVector moved = loaded.q - free.q;
    EXPECT_LT((r.q * Q - moved).norm(), 1e-6 * moved.norm() + 1e-12) << shape << " " << trial;
    EXPECT_LT((r.q_dot * Q - (loaded.q_dot - free.q_dot)).norm(), 1e-6 * (loaded.q_dot - free.q_dot).norm() + 1e-12)
        << shape << " " << trial;
  }
}

TEST(Paper, FollowsAFamilyThatReturnsToZero) {
  std::mt19937 random(29);
  for (const std::string& shape : test_support::shape_names()) {
    Case c = random_case(shape, 1.0, 1.0, random);
    c.hand = motion::MotionSegment(c.hand.at(0.0).X);
    StrainState state = carried(c, 0.0, 0.02, 50, c.held.zero_state());
    state = c.held.set_dofs({true, true, false}, 1.0, 0.05, c.held.full_state(1.0, state));
    ASSERT_TRUE(c.held.returning());
    const auto integrator = paper();
    double t = 1.0;
    for (; t < 6.0; t += 0.02) {
      integrator->step(c.held, c.hand, t, 0.02, state);
      c.held.drop_finished_returns(t + 0.02);
      ASSERT_TRUE(state.q.allFinite());
    }
    const rod::StrainVector a = c.held.acceleration(c.held.state_at(c.hand, t), state.q, state.q_dot);
    EXPECT_LT((c.held.object_jacobian(t, state.q) * a).norm(), 1e-6) << shape;
  }
}

}  // namespace
}  // namespace spring_workbench::stepping::paper_test
