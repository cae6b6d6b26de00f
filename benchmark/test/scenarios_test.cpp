#include "benchmark/scenarios.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "benchmark/exact_oscillator.h"
#include "benchmark/function_hand.h"
#include "benchmark/held_body.h"
#include "benchmark/reference_solution.h"
#include "benchmark/rod_reference.h"
#include "benchmark/scene_solver.h"
#include "spring_workbench/math/so3.h"

namespace spring_workbench::benchmark::scenarios_test {
namespace {

std::vector<Scenario> all_scenes() {
  return {stretch_scene(1e2), stretch_scene(1e4), torsion_scene(1e3), six_dof_scene(1.0), six_dof_scene(100.0)};
}

/// Fourth-order central difference of `f` at `t`.
template <typename Function>
auto derivative(const Function& f, double t) {
  const double h = 1e-3;
  return ((8.0 * (f(t + h) - f(t - h)) - (f(t + 2.0 * h) - f(t - 2.0 * h))) / (12.0 * h)).eval();
}

/// The object in world by RK4 on the Newton–Euler equations under `bushing_load`; shares neither coordinates nor
/// integrator with the reference.
std::vector<Vector3d> outputs_by_world_rk4(const Scenario& scene, int steps_per_interval) {
  using State = Eigen::Matrix<double, 13, 1>;
  const auto unpack = [](const State& y) {
    BodyState body;
    body.p_WO = y.segment<3>(0);
    body.v_WO_W = y.segment<3>(3);
    body.R_WO.coeffs() = y.segment<4>(6);
    body.R_WO.normalize();
    body.w_WO_O = y.segment<3>(10);
    return body;
  };
  const auto rate = [&](double t, const State& y) {
    const BodyState body = unpack(y);
    const BodyAcceleration a = body_acceleration(scene, bushing_load(scene, hand_state(scene, t), body), body.w_WO_O);
    const Quaterniond w(0.0, body.w_WO_O.x(), body.w_WO_O.y(), body.w_WO_O.z());
    const Quaterniond q(y[9], y[6], y[7], y[8]);
    State r;
    r << body.v_WO_W, a.a_WO_W, 0.5 * (q * w).coeffs(), a.alpha_WO_O;
    return r;
  };
  const BodyState start = start_state(scene);
  State y;
  y << start.p_WO, start.v_WO_W, start.R_WO.coeffs(), start.w_WO_O;
  std::vector<Vector3d> outputs{y.head<3>()};
  const std::vector<double> times = output_times(scene);
  const double h = scene.output_interval / steps_per_interval;
  for (std::size_t i = 0; i + 1 < times.size(); ++i) {
    for (int j = 0; j < steps_per_interval; ++j) {
      const double t = times[i] + j * h;
      const State k1 = rate(t, y);
      const State k2 = rate(t + 0.5 * h, y + 0.5 * h * k1);
      const State k3 = rate(t + 0.5 * h, y + 0.5 * h * k2);
      const State k4 = rate(t + h, y + h * k3);
      y += h / 6.0 * (k1 + 2.0 * k2 + 2.0 * k3 + k4);
    }
    outputs.push_back(y.head<3>());
  }
  return outputs;
}

TEST(Scenarios, HandVelocityAndAccelerationAreDerivativesOfThePose) {
  std::vector<Scenario> scenes = all_scenes();
  for (Scenario scene : all_scenes()) {
    scene.ramp = kRamp;
    scenes.push_back(scene);
  }
  for (const Scenario& scene : scenes) {
    for (const auto& [state, motion] :
         {std::pair{&hand_state, &hand_motion}, std::pair{&handle_state, &handle_motion}}) {
      for (const double t : {0.0, 0.37, 1.9, 3.3}) {
        const HandState now = state(scene, t);
        const Vector3d v = derivative([&](double s) { return state(scene, s).p_WT; }, t);
        const Vector3d a = derivative([&](double s) { return state(scene, s).v_WT_W; }, t);
        const Vector3d alpha = derivative([&](double s) { return state(scene, s).w_WT_T; }, t);
        const Matrix3d R_dot = derivative([&](double s) { return state(scene, s).R_WT; }, t);
        EXPECT_LT((v - now.v_WT_W).norm(), 1e-8) << scene.name;
        EXPECT_LT((R_dot - now.R_WT * math::skew(now.w_WT_T)).norm(), 1e-7) << scene.name;
        EXPECT_LT((a - motion(scene, t).acceleration.a_WT_W).norm(), 1e-7) << scene.name;
        EXPECT_LT((alpha - motion(scene, t).acceleration.alpha_WT_T).norm(), 1e-7) << scene.name;
      }
    }
  }
}

TEST(Scenarios, ASampledHandStartsFromRestAndThenGoesThePathOfTheFunction) {
  for (const Scenario& known : all_scenes()) {
    Scenario scene = known;
    scene.ramp = kRamp;
    const HandMotion start = hand_motion(scene, 0.0);
    EXPECT_EQ(start.state.v_WT_W.norm() + start.state.w_WT_T.norm(), 0.0);
    EXPECT_EQ(start.acceleration.a_WT_W.norm() + start.acceleration.alpha_WT_T.norm(), 0.0);
    for (const double t : {kRamp, 1.7}) {
      const HandState there = hand_state(scene, t), then = hand_state(known, t - 0.5 * kRamp);
      EXPECT_LT((there.p_WT - then.p_WT).norm() + (there.R_WT - then.R_WT).norm(), 1e-14);
      EXPECT_LT((there.v_WT_W - then.v_WT_W).norm() + (there.w_WT_T - then.w_WT_T).norm(), 1e-13);
    }
    const Scenario sampled = with_sampled_hand(known);
    for (const double t : {0.02, 0.2, 1.0}) {
      EXPECT_LT((hand_state(sampled, t).p_WT - hand_state(scene, t).p_WT).norm(), 1e-14);
    }
  }
}

TEST(Scenarios, HandleIsTheForksLengthBehindTheTip) {
  for (const Scenario& scene : all_scenes()) {
    const HandState tip = hand_state(scene, 0.7), handle = handle_state(scene, 0.7);
    EXPECT_NEAR((tip.R_WT.transpose() * (tip.p_WT - handle.p_WT) - scene.length * Vector3d::UnitZ()).norm(), 0.0,
                1e-15);
  }
}

TEST(Scenarios, AHandThatIsAFunctionIsTheSameAtFourTimesAtOnce) {
  for (const Scenario& scene : all_scenes()) {
    const FunctionHand hand(scene);
    const math::Pack t{0.0, 0.3, 1.7, 3.9};
    const motion::BodyFrameRates<math::Pack> all = hand.body_frame_rates(t, 9.81);
    for (int i = 0; i < math::pack_size; ++i) {
      const motion::BodyRateState one = hand.body_rate_state(t[i]);
      const Matrix3d R = math::matrix(all.R_WB, i);
      EXPECT_EQ(R, one.X.linear());
      EXPECT_LT((R * math::vector(all.v_B, i) - one.v_W).norm(), 1e-14);
      EXPECT_LT((R * math::vector(all.a_B, i) - one.a_W - 9.81 * Vector3d::UnitZ()).norm(), 1e-13);
      EXPECT_EQ(math::vector(all.w_B, i), one.w_B);
      EXPECT_EQ(math::vector(all.alpha_B, i), one.alpha_B);
    }
  }
}

int times_asked = 0;
double counted(const Scenario&, double t) {
  ++times_asked;
  return 2.0 * t;
}

TEST(Scenarios, WhatIsRememberedIsAskedForOnceForEachMomentOfARungeKuttaStep) {
  Remembered<double, &counted> hand;
  const Scenario scene = stretch_scene(1e2);
  constexpr int steps = 100;
  constexpr double h = 0.1 / 3.0;
  for (int i = 0; i < steps; ++i) {
    const double t = i * h;
    for (const double at : {t, t + 0.5 * h, t + 0.5 * h, t + h}) EXPECT_NEAR(hand.at(scene, at), 2.0 * at, 1e-12);
  }
  EXPECT_EQ(times_asked, 2 * steps + 1);
}

TEST(Scenarios, BodyAndBushingStateAreInversesOfEachOther) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  const Scenario scene = six_dof_scene(1.0);
  for (int n = 0; n < 200; ++n) {
    BushingState state;
    state.q = Vector6d::NullaryExpr([&] { return uniform(random); });
    state.q_dot = Vector6d::NullaryExpr([&] { return 5.0 * uniform(random); });
    const HandState hand = hand_state(scene, uniform(random));
    const BushingState back = bushing_state(scene, hand, body_state(scene, hand, state));
    EXPECT_LT((back.q - state.q).norm(), 1e-13);
    EXPECT_LT((back.q_dot - state.q_dot).norm(), 1e-12);
  }
}

TEST(Scenarios, BushingLoadDoesTheVirtualWorkOfTheGeneralisedForces) {
  std::mt19937 random(2);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  const Scenario scene = six_dof_scene(1.0);
  for (int n = 0; n < 200; ++n) {
    BushingState state;
    state.q = Vector6d::NullaryExpr([&] { return uniform(random); });
    state.q_dot = Vector6d::NullaryExpr([&] { return uniform(random); });
    HandState hand = hand_state(scene, uniform(random));
    const BodyState body = body_state(scene, hand, state);
    const BodyLoad load = bushing_load(scene, hand, body);
    // With the hand held still, the object's velocity for the rates δ is the virtual displacement.
    hand.v_WT_W.setZero();
    hand.w_WT_T.setZero();
    BushingState virtual_rate = state;
    virtual_rate.q_dot = Vector6d::NullaryExpr([&] { return uniform(random); });
    const BodyState moved = body_state(scene, hand, virtual_rate);
    const double power = load.force_W.dot(moved.v_WO_W) + load.moment_O.dot(moved.w_WO_O);
    const double expected =
        -(scene.stiffness.cwiseProduct(state.q) + scene.damping.cwiseProduct(state.q_dot)).dot(virtual_rate.q_dot);
    EXPECT_NEAR(power, expected, 1e-9 * (1.0 + std::abs(expected)));
  }
}

TEST(Scenarios, ExactDeflectionSatisfiesItsEquationOfMotionAtEveryDampingRatio) {
  for (const double zeta : {0.0, 0.1, 1.0 - 1e-7, 1.0, 1.0 + 1e-7, 3.0, 10.0}) {
    for (const double k : {1e2, 1e4, 1e6}) {
      for (const Scenario& scene : {stretch_scene(k, zeta), torsion_scene(k, zeta)}) {
        const int i = scene.single_coordinate();
        const double weight = i == 2 ? scene.mass * scene.gravity : 0.0;
        EXPECT_NEAR(exact_deflection(scene, 0.0).value, 0.0, 1e-14);
        EXPECT_NEAR(exact_deflection(scene, 0.0).rate, 0.0, 1e-12);
        for (const double t : {0.0, 1e-4, 0.01, 0.2, 1.0, 3.7}) {
          const ScalarMotion x = exact_deflection(scene, t), u = scalar_hand(scene, t);
          const double inertial = scene.single_inertia() * (x.acceleration + u.acceleration);
          const double terms = std::abs(inertial) + std::abs(scene.stiffness[i] * x.value) + weight;
          const double residual = inertial + scene.damping[i] * x.rate + scene.stiffness[i] * x.value + weight;
          EXPECT_LT(std::abs(residual), 1e-8 * (terms + scene.single_inertia()))
              << scene.name << " k " << k << " zeta " << zeta << " t " << t;
        }
      }
    }
  }
}

TEST(Scenarios, ExactRatesAreDerivativesOfTheDeflection) {
  for (const double zeta : {0.1, 1.0, 3.0}) {
    for (const Scenario& scene : {stretch_scene(1e3, zeta), torsion_scene(1e2, zeta)}) {
      for (const double t : {0.05, 0.5, 2.0}) {
        const auto value = [&](double s) { return Vector3d::Constant(exact_deflection(scene, s).value); };
        const auto rate = [&](double s) { return Vector3d::Constant(exact_deflection(scene, s).rate); };
        EXPECT_NEAR(derivative(value, t)[0], exact_deflection(scene, t).rate, 1e-5);
        EXPECT_NEAR(derivative(rate, t)[0], exact_deflection(scene, t).acceleration, 1e-3);
      }
    }
  }
}

TEST(Scenarios, StiffSpringsFollowTheHandWithTheSagOfTheirWeight) {
  const Scenario scene = stretch_scene(1e10);
  for (const double t : {0.5, 1.7}) {
    const double force = scene.mass * (scene.gravity + scalar_hand(scene, t).acceleration);
    EXPECT_NEAR(exact_deflection(scene, t).value * 1e10 / force, -1.0, 1e-3);
  }
}

std::vector<Vector3d> cvode_outputs(const Scenario& scene, SceneCoordinates coordinates) {
  const auto make = [](int size, OdeSolver::Rates rates) {
    return make_cvode(CvodeFormula::bdf, size, std::move(rates));
  };
  return SceneSolver(scene, coordinates, make).solve(1e-12);
}

TEST(Reference, CvodeAgreesWithTheExactSolutionOfScenesAAndB) {
  for (const double k : {1e2, 1e4, 1e6, 1e8}) {
    for (const Scenario& scene : {stretch_scene(k), torsion_scene(k)}) {
      const ReferenceSolution exact = reference_solution(scene);
      for (const SceneCoordinates coordinates : {SceneCoordinates::deflection, SceneCoordinates::world}) {
        EXPECT_LT(output_error(scene, exact, cvode_outputs(scene, coordinates)), 1e-9) << scene.name << " k " << k;
      }
    }
  }
}

TEST(Reference, SceneCAgreesWithCvodeInEitherFormulation) {
  for (const auto& [factor, mass] : {std::pair{1.0, 5.0}, {1e4, 5.0}, {1.0, 1e-3}, {1e4, 1e3}}) {
    Scenario scene = six_dof_scene(factor, 1.0, mass);
    scene.duration = 1.0;
    const ReferenceSolution reference = reference_solution(scene);
    EXPECT_LT(reference.uncertainty, 2e-13) << factor << ' ' << mass;
    EXPECT_LT(output_error(scene, reference, cvode_outputs(scene, SceneCoordinates::deflection)), 1e-11)
        << factor << ' ' << mass;
    EXPECT_LT(output_error(scene, reference, cvode_outputs(scene, SceneCoordinates::world)), 1e-9)
        << factor << ' ' << mass;
  }
}

TEST(Reference, OnASampledHandTheExactPiecesAreWhatRadauComesTo) {
  for (const double zeta : {0.1, 1.0, 3.0}) {
    for (const Scenario& known : {stretch_scene(1e2, zeta), stretch_scene(1e6, zeta), torsion_scene(1e4, zeta)}) {
      const Scenario scene = with_sampled_hand(known);
      const ReferenceSolution exact = reference_solution(scene);
      std::vector<Vector3d> fine;
      for (const RigidTransform& X : fine_poses(rod_case(scene), "bushing", 1e-12))
        fine.push_back(scene_output(scene, X));
      EXPECT_LT(output_error(scene, exact, fine), 1e-12) << scene.name << ' ' << scene.stiffness_factor << ' ' << zeta;
      EXPECT_GT(exact.hand_error, 1e-9);
    }
  }
}

TEST(Reference, SceneCAgreesWithRungeKuttaInWorldCoordinates) {
  for (const auto& [factor, steps] : {std::pair{1.0, 200}, std::pair{100.0, 1000}, std::pair{1e4, 4000}}) {
    const Scenario scene = six_dof_scene(factor);
    const ReferenceSolution reference = reference_solution(scene);
    EXPECT_LT(output_error(scene, reference, outputs_by_world_rk4(scene, steps)), 1e-9) << "factor " << factor;
    EXPECT_GT(reference.largest_deflection, 1e-3 / factor);
  }
}

}  // namespace
}  // namespace spring_workbench::benchmark::scenarios_test
