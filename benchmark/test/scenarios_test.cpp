#include "benchmark/scenarios.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "benchmark/exact_oscillator.h"
#include "benchmark/held_body.h"
#include "benchmark/reference_solution.h"
#include "benchmark/rod_reference.h"
#include "benchmark/scene_solver.h"
#include "benchmark/sine_and_cosine.h"
#include "spring_workbench/math/so3.h"

namespace spring_workbench::benchmark {
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

/// The object in world by RK4 on Newton's and Euler's equations under `bushing_load`: shares neither coordinates nor
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
  for (const Scenario& scene : all_scenes()) {
    for (const auto& [state, acceleration] :
         {std::pair{&hand_state, &hand_acceleration}, std::pair{&handle_state, &handle_acceleration}}) {
      for (const double t : {0.0, 0.37, 1.9, 3.3}) {
        const HandState now = state(scene, t);
        const Vector3d v = derivative([&](double s) { return state(scene, s).p_WT; }, t);
        const Vector3d a = derivative([&](double s) { return state(scene, s).v_WT_W; }, t);
        const Vector3d alpha = derivative([&](double s) { return state(scene, s).w_WT_T; }, t);
        const Matrix3d R_dot = derivative([&](double s) { return state(scene, s).R_WT; }, t);
        EXPECT_LT((v - now.v_WT_W).norm(), 1e-8) << scene.name;
        EXPECT_LT((R_dot - now.R_WT * math::skew(now.w_WT_T)).norm(), 1e-7) << scene.name;
        EXPECT_LT((a - acceleration(scene, t).a_WT_W).norm(), 1e-7) << scene.name;
        EXPECT_LT((alpha - acceleration(scene, t).alpha_WT_T).norm(), 1e-7) << scene.name;
      }
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

TEST(Scenarios, SinesOfFourAnglesAreTheLibrarys) {
  std::mt19937 random(3);
  for (const double most : {1e-3, 1.0, 10.0, 1e5}) {
    std::uniform_real_distribution<double> angle(-most, most);
    for (int n = 0; n < 10000; ++n) {
      const math::Pack x{angle(random), angle(random), angle(random), angle(random)};
      const SineAndCosine<math::Pack> of = sine_and_cosine(x);
      for (int i = 0; i < math::pack_size; ++i) {
        EXPECT_NEAR(of.sine[i], std::sin(x[i]), 3e-16 * std::min(1.0, most)) << x[i];
        EXPECT_NEAR(of.cosine[i], std::cos(x[i]), 3e-16) << x[i];
      }
    }
  }
}

TEST(Scenarios, HandleAtFourTimesIsTheHandleAtEachOfThem) {
  const auto expect_near = [](const math::Three<math::Pack>& packs, const Vector3d& one, int i, double tolerance) {
    EXPECT_LT((math::vector(packs, i) - one).norm(), tolerance);
  };
  for (const Scenario& scene : all_scenes()) {
    const math::Pack t{0.0, 0.3, 1.7, 3.9};
    HandleMotion<math::Pack> at;
    handle_motion(scene, t, at);
    for (int i = 0; i < math::pack_size; ++i) {
      const HandState state = handle_state(scene, t[i]);
      const HandAcceleration acceleration = handle_acceleration(scene, t[i]);
      EXPECT_LT((math::matrix(at.R_WH, i) - state.R_WT).norm(), 1e-14);
      expect_near(at.p_W, state.p_WT, i, 1e-14);
      expect_near(at.v_W, state.v_WT_W, i, 1e-13);
      expect_near(at.w_H, state.w_WT_T, i, 1e-13);
      expect_near(at.a_W, acceleration.a_WT_W, i, 1e-12);
      expect_near(at.alpha_H, acceleration.alpha_WT_T, i, 1e-12);
    }
  }
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
}  // namespace spring_workbench::benchmark
