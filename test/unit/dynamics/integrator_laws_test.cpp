#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <cmath>
#include <map>
#include <random>

#include "spring_workbench/dynamics/integrator.h"
#include "spring_workbench/validation/names.h"
#include "support/held_cases.h"
#include "support/matrix_exponential.h"
#include "support/named.h"
#include "support/tracked_hand.h"

namespace spring_workbench::dynamics::integrator_laws_test {
namespace {

StrainState carried(Integrator& integrator, const Case& c, double t, double h, int steps, StrainState state) {
  for (int i = 0; i < steps; ++i) integrator.step(c.held, c.hand, t + i * h, h, state);
  return state;
}

/// Solution at 0.2 s by the classical Runge–Kutta method at a fine step; computed once per rod.
const StrainState& fine_solution(const Case& c, const std::string& shape, rod::DampingLaw law) {
  static std::map<std::pair<std::string, rod::DampingLaw>, StrainState> made;
  constexpr int steps = 8192;
  const auto found = made.find({shape, law});
  if (found != made.end()) return found->second;
  return made[{shape, law}] = carried(*dynamics::make_integrator(dynamics::IntegratorKind::rk4), c, 0.0, 0.2 / steps,
                                      steps, c.held.zero_state());
}

class EveryIntegrator : public testing::TestWithParam<std::string> {};

TEST_P(EveryIntegrator, HasItsOrderOfAccuracy) {
  // By step halving, every shape model and damping law; against the classical Runge–Kutta method at a fine step.
  const int order = test_support::make_integrator(GetParam())->order();
  std::vector<std::pair<std::string, rod::DampingLaw>> rods{{"linear", rod::DampingLaw::modal}};
  for (const std::string& shape : test_support::shape_names()) {
    rods.emplace_back(shape, rod::DampingLaw::per_dof);
  }
  for (const auto& [shape, law] : rods) {
    std::mt19937 random(5);
    const Case c = random_case(shape, 0.4, 0.2, random, law);
    const StrainState begin = c.held.zero_state();
    const StrainState& exact = fine_solution(c, shape, law);
    const auto error = [&](int steps) {
      return distance(c, 0.2, carried(*test_support::make_integrator(GetParam()), c, 0.0, 0.2 / steps, steps, begin),
                      exact);
    };
    // Steps of about ω h = 0.2 or, of low order, less; 1; and, of order one, 1/1000 of the time.
    const int per_omega = static_cast<int>(0.2 * c.omega);
    const int steps = order == 1                         ? 1000
                      : limited_by_stiffness(GetParam()) ? (order < 4 ? 40 : 5) * per_omega
                                                         : 5 + per_omega;
    const double coarse = error(steps), fine = error(2 * steps);
    const double found = std::log2(coarse / fine);
    if (GetParam() == "exponential") {  // seven, where the step resolves every mode
      EXPECT_GT(found, order - 0.5) << shape << " " << coarse << " " << fine;
      EXPECT_LT(found, order + 2.5) << shape << " " << coarse << " " << fine;
    } else {
      EXPECT_NEAR(found, order, order >= 4 ? 0.5 : 0.1) << shape << " " << coarse << " " << fine;
    }
  }
}

/// Energy changes by the work done, which a method that knows its path knows to the order of its step.
TEST_P(EveryIntegrator, KnowsTheWorkOfAStepOrDoesNotTellIt) {
  for (const std::string& shape : test_support::shape_names()) {
    for (const double zeta : {0.0, 0.3, 1.0}) {
      std::mt19937 random(11);
      const Case c = random_case(shape, zeta, 1.0, random);
      const auto error = [&](double h) {
        const auto integrator = test_support::make_integrator(GetParam());
        StrainState state = carried(*integrator, c, 0.0, 0.01, 5, c.held.zero_state());
        const auto balance = [&](double t) {
          math::Pack q[rod::max_strain_coordinates], q_dot[rod::max_strain_coordinates];
          for (int i = 0; i < c.held.size(); ++i) {
            q[i] = state.q[i] + math::Pack{};
            q_dot[i] = state.q_dot[i] + math::Pack{};
          }
          return c.held.energy_balance(c.held.state_at(c.hand, t + math::Pack{}), q, q_dot).energy[0];
        };
        const double before = balance(0.05);
        integrator->step(c.held, c.hand, 0.05, h, state);
        const std::optional<StepWork> step = integrator->work(c.held);
        EXPECT_EQ(step.has_value(), GetParam() == "exponential");
        if (!step) return 0.0;
        EXPECT_NEAR(step->energy_at_end, balance(0.05 + h), 1e-12 * (1.0 + std::abs(before)));
        return std::abs(step->energy_at_end - before - step->work);
      };
      const double h = 1.0 / c.omega, coarse = error(h), fine = error(0.5 * h);
      EXPECT_LE(fine, 1e-13 + coarse / 64.0) << shape << " " << zeta << " " << coarse << " " << fine;
    }
  }
}

TEST_P(EveryIntegrator, EstimatesItsLocalErrorWithinAFactorOfTenInNineStepsOfTen) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  int within = 0, all = 0;
  for (int trial = 0; trial < 60; ++trial) {
    const double zeta = trial % 3 == 0 ? 0.1 : trial % 3 == 1 ? 1.0 : 3.0;
    const std::string shape =
        test_support::shape_names()[static_cast<std::size_t>(trial) % test_support::shape_names().size()];
    const Case c = random_case(shape, zeta, 1.0, random);
    // Steps from well resolved to (if the method allows) stiff.
    const double omega_dt = limited_by_stiffness(GetParam()) ? 0.02 * std::pow(20.0, uniform(random)) / (1.0 + zeta)
                                                             : 0.05 * std::pow(1000.0, uniform(random));
    const double h = std::min(omega_dt / c.omega, 0.05);
    const int finer = 10 + static_cast<int>(std::ceil(20.0 * (1.0 + zeta) * h * c.omega));
    const auto integrator = test_support::make_integrator(GetParam()),
               reference = dynamics::make_integrator(dynamics::IntegratorKind::rk4);
    StrainState state = c.held.zero_state();
    for (int i = 0; i < 10; ++i) {
      const StrainState begin = state;
      const StepEstimate e = integrator->step(c.held, c.hand, i * h, h, state);
      const StrainState exact = carried(*reference, c, i * h, h / finer, finer, begin);
      const double t = (i + 1) * h, truth = distance(c, t, state, exact);
      if (!(truth > 1e-12)) continue;  // rounding
      const double ratio = distance(c, t, {exact.q + e.q_error, exact.q_dot}, exact) / truth;
      if (ratio > 0.1 && ratio < 10.0) ++within;
      ++all;
    }
  }
  ASSERT_GT(all, 200);
  EXPECT_GT(within, 0.9 * all) << within << " of " << all;
}

/// Also from sample to sample of a tracked hand, whose acceleration jumps there.
TEST_P(EveryIntegrator, EstimatesItsLocalErrorUnderATrackedHandWithinAFactorOfTen) {
  int all = 0;
  for (unsigned trial = 0; trial < 24; ++trial) {
    std::mt19937 random(100 + trial);
    const double zeta[] = {0.1, 0.5, 1.0, 3.0}, noise[] = {0.0, 1e-4, 1e-3};
    const std::vector<std::string> shapes = test_support::shape_names();
    Case c = random_case(shapes[trial % shapes.size()], zeta[trial % 4], 1.0, random);
    motion::PoseTrack track = test_support::tracked_hand(0.3, noise[trial % 3], random);
    const bool limited = limited_by_stiffness(GetParam());
    const int parts = limited ? static_cast<int>(std::ceil(0.02 * c.omega * (1.0 + zeta[trial % 4]) / 0.2)) : 1;
    const int finer = 10 + static_cast<int>(std::ceil(20.0 * (1.0 + zeta[trial % 4]) * 0.02 / parts * c.omega));
    const auto integrator = test_support::make_integrator(GetParam()),
               reference = dynamics::make_integrator(dynamics::IntegratorKind::rk4);
    StrainState state = c.held.zero_state();
    for (double t = 0.0; t < 0.19;) {
      c.hand = track.segment(t);
      const double end = c.hand.end(), h = (end - t) / parts;
      for (int part = 0; part < parts; ++part) {
        const StrainState begin = state;
        const double at = t + part * h;
        const StepEstimate e = integrator->step(c.held, c.hand, at, h, state);
        const StrainState exact = carried(*reference, c, at, h / finer, finer, begin);
        const double truth = distance(c, at + h, state, exact);
        if (!(truth > 1e-12)) continue;  // rounding
        const double ratio = distance(c, at + h, {exact.q + e.q_error, exact.q_dot}, exact) / truth;
        EXPECT_GT(ratio, 0.1) << trial << " " << at;
        EXPECT_LT(ratio, 10.0) << trial << " " << at;
        ++all;
      }
      t = end;
    }
  }
  EXPECT_GT(all, 200);
}

INSTANTIATE_TEST_SUITE_P(Integrators, EveryIntegrator,
                         testing::ValuesIn(test_support::equation_of_motion_integrator_names()),
                         [](const auto& instance) { return instance.param; });

/// A deviation is carried as the difference of two steps is: exactly, or by the linear part of a method that has one.
TEST(AnyIntegrator, CarriesADeviationAsTwoStepsDo) {
  for (const std::string& name : validation::names<IntegratorKind>()) {
    for (const std::string& shape : test_support::shape_names()) {
      for (const double zeta : {0.1, 1.0, 3.0}) {
        std::mt19937 random(3);
        const Case c = random_case(shape, zeta, 1.0, random);
        const double h = 0.3 / (1.0 + zeta) / c.omega;
        const auto integrator = test_support::make_integrator(name), beside = test_support::make_integrator(name);
        const StrainState begin = carried(*integrator, c, 0.0, h, 5, c.held.zero_state());
        carried(*beside, c, 0.0, h, 5, c.held.zero_state());
        StrainState end = begin, deviation = c.held.zero_state();
        integrator->step(c.held, c.hand, 5 * h, h, end);
        for (int i = 0; i < c.held.size(); ++i) {
          deviation.q[i] = 1e-5 * c.held.units()[i];
          deviation.q_dot[i] = (i % 2 == 0 ? -1e-5 : 1e-5) * c.omega * c.held.units()[i];
        }
        StrainState off{begin.q + deviation.q, begin.q_dot + deviation.q_dot};
        beside->step(c.held, c.hand, 5 * h, h, off);
        integrator->propagate_deviation(c.held, c.hand, 5 * h, h, begin, end, deviation);
        const bool linear_part = name == "exponential" || name == "rosenbrock" || name == "implicit_euler";
        const double accuracy = linear_part ? 0.05 : 1e-6;
        const rod::StrainVector q = off.q - end.q, q_dot = off.q_dot - end.q_dot;
        EXPECT_LT((deviation.q - q).norm(), accuracy * q.norm()) << name << " " << shape << " " << zeta;
        EXPECT_LT((deviation.q_dot - q_dot).norm(), accuracy * q_dot.norm()) << name << " " << shape << " " << zeta;
      }
    }
  }
}

/// The equation of a stretch alone is linear: a step from a strain so far off that the differences of one near zero are
/// lost in its rounding is as much longer as the strain is.
TEST(StiffIntegrator, AStretchFarOffMovesAsOneLessFarOff) {
  for (const char* name : {"exponential", "implicit_euler"}) {
    for (unsigned trial = 0; trial < 10; ++trial) {
      std::mt19937 random(trial);
      Case c = random_case("linear", 0.1, 1.0, random);
      c.held.set_dofs({true, false, false}, 0.0, 0.05, c.held.zero_state());
      const auto moved = [&](double far) -> Eigen::Vector2d {
        StrainState state = c.held.zero_state();
        state.q[0] = far;
        EXPECT_TRUE(test_support::make_integrator(name)->step(c.held, c.hand, 0.1, 0.002, state).converged)
            << name << " " << trial << " " << far;
        return Eigen::Vector2d(state.q[0], state.q_dot[0]) / far;
      };
      const Eigen::Vector2d less_far = moved(1e6);
      for (const double far : {1e9, 1e13, 1e20}) {
        EXPECT_LT((moved(far) - less_far).norm(), 1e-4 * less_far.norm()) << name << " " << trial << " " << far;
      }
    }
  }
}

/// x, ẋ at `t` [s] of ẍ + 2 ζ ω ẋ + ω² x = α + β t from rest at zero, in long double.
Eigen::Matrix<long double, 2, 1> oscillator(long double omega, long double zeta, long double alpha, long double beta,
                                            long double t) {
  test_support::LongMatrix A = test_support::LongMatrix::Zero(4, 4);  // of (ω x, ẋ, (α + β t) / ω, β / ω²)
  A(0, 1) = omega;
  A(1, 0) = -omega;
  A(1, 1) = -2.0L * zeta * omega;
  A(1, 2) = omega;
  A(2, 3) = omega;
  const test_support::LongMatrix to_end = test_support::exponential(A * t);
  const long double a = alpha / omega, b = beta / (omega * omega);
  return {(to_end(0, 2) * a + to_end(0, 3) * b) / omega, to_end(1, 2) * a + to_end(1, 3) * b};
}

/// With one coordinate and a hand whose acceleration is linear in time, the motion is exact to rounding in any number
/// of steps, even if both rates of the mode nearly coincide.
TEST(Exponential, IsExactInOneCoordinateHoweverCloseToCriticalDamping) {
  std::mt19937 random(11);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  for (int trial = 0; trial < 200; ++trial) {
    dynamics::BodyInertia body;
    body.mass = std::pow(10.0, uniform(random));
    body.inertia_O = body.mass * Matrix3d::Identity();
    HeldBody held(rod::make_shape_model(test_support::shape_named("bushing"), 0.2), body, 9.81);
    const double omega = std::pow(10.0, 1.0 + uniform(random)), k = body.mass * omega * omega;
    const double off =
        trial % 10 == 0 ? 0.0 : std::copysign(std::pow(10.0, 8.0 * uniform(random) - 8.0), uniform(random));
    const double zeta = 1.0 + 0.5 * off;
    held.set_springs(rod::PerDof{k, k, k}, {zeta, zeta, zeta});
    held.set_dofs({true, false, false}, 0.0, 0.05, held.zero_state());
    constexpr double duration = 0.4;
    motion::PoseSample a, b;
    b.t = duration;
    a.X = b.X = RigidTransform::Identity();
    b.X.translation().z() = 0.1 * uniform(random);
    const motion::MotionSegment hand(a, Vector3d(0, 0, uniform(random)), Vector3d::Zero(), b,
                                     Vector3d(0, 0, uniform(random)), Vector3d::Zero());
    const rod::StrainVector zero = rod::StrainVector::Zero(1);
    const double alpha = held.acceleration(held.state_at(hand, 0.0), zero, zero)[0],
                 beta =
                     (held.acceleration(held.state_at(hand, 0.5 * duration), zero, zero)[0] - alpha) / (0.5 * duration);
    const auto exact = oscillator(omega, zeta, alpha, beta, duration);
    const double size = (std::abs(alpha) + duration * std::abs(beta)) / (omega * omega);
    for (const int steps : {1, 5, 40, 320}) {
      const Case c{held, hand, omega};
      const auto integrator = test_support::make_integrator("exponential");
      const StrainState end = carried(*integrator, c, 0.0, duration / steps, steps, held.zero_state());
      EXPECT_NEAR(end.q[0], static_cast<double>(exact[0]), 2e-13 * size) << off << " " << omega << " " << steps;
      EXPECT_NEAR(end.q_dot[0], static_cast<double>(exact[1]), 2e-13 * size * omega) << off << " " << steps;
    }
  }
}

/// How many modes of the held body at zero strain oscillate.
Eigen::Index oscillating(const HeldBody& held) {
  const Eigen::Index n = held.size();
  const Eigen::LLT<Eigen::MatrixXd> M(Eigen::MatrixXd(held.mass_matrix(0.0, rod::StrainVector::Zero(n))));
  Eigen::MatrixXd A = Eigen::MatrixXd::Zero(2 * n, 2 * n);
  A.topRightCorner(n, n).setIdentity();
  A.bottomLeftCorner(n, n) = -M.solve(Eigen::MatrixXd(held.stiffness().asDiagonal()));
  A.bottomRightCorner(n, n) = -M.solve(Eigen::MatrixXd(held.damping()));
  return (A.eigenvalues().imag().array() > 0.0).count();
}

/// Of several coordinates that dampers of their own couple, too, at the damping where a coupled mode ceases to
/// oscillate and at relative distances from it of 1e-12 to 0.1: the error falls with the step down to rounding.
TEST(Exponential, HasNoFloorHoweverCloseToCriticalDampingOfACoupledMode) {
  constexpr double duration = 0.2;
  for (const char* shape : {"bushing", "linear"}) {
    for (const unsigned seed : {1u, 2u}) {
      const auto at_ratio = [&](double zeta) {
        std::mt19937 random(seed);
        return random_case(shape, zeta, duration, random);
      };
      double below = 0.3, above = 3.0;
      const Eigen::Index all = oscillating(at_ratio(below).held);
      ASSERT_LT(oscillating(at_ratio(above).held), all);
      for (int i = 0; i < 60; ++i) {
        const double middle = 0.5 * (below + above);
        (oscillating(at_ratio(middle).held) == all ? below : above) = middle;
      }
      for (const double apart : {0.0, 1e-12, -1e-12, 1e-8, -1e-8, 1e-4, -1e-4, 0.1, -0.1}) {
        const Case c = at_ratio(below * (1.0 + apart));
        const auto end = [&](const char* integrator, int steps) {
          return carried(*test_support::make_integrator(integrator), c, 0.0, duration / steps, steps,
                         c.held.zero_state());
        };
        const StrainState coarse = end("rk4", 4096), fine = end("rk4", 8192);
        const StrainState exact{fine.q + (fine.q - coarse.q) / 15.0, fine.q_dot};
        const double coarse_error = distance(c, duration, end("exponential", 40), exact),
                     fine_error = distance(c, duration, end("exponential", 1280), exact);
        EXPECT_LT(coarse_error, 1e-8) << shape << " " << seed << " " << apart;
        EXPECT_LT(fine_error, 1e-12) << shape << " " << seed << " " << apart;
      }
    }
  }
}

/// A history, also one of no step yet, replaces whatever the integrator has done before, of other bodies, steps and
/// times.
TEST(Exponential, GoesOnBitIdenticallyFromARestoredHistoryWhateverItDidBefore) {
  std::mt19937 random(1);
  const Case c = random_case("linear", 1.0, 0.4, random), other = random_case("linear", 0.3, 0.4, random);
  const auto integrator = test_support::make_integrator("exponential"),
             restored = test_support::make_integrator("exponential");
  StrainState state = c.held.zero_state(), elsewhere = other.held.zero_state();
  const double h = 0.02;
  for (int i = 0; i < 10; ++i) {
    math::StateArchive saved;
    saved(*integrator);
    const math::StateArchive::Words words = saved.words();
    for (const double share : {0.6, 1.0}) {  // looks ahead, as the displayed copy does
      restored->step(other.held, other.hand, i * h, share * h, elsewhere);
      math::StateArchive given(words);
      given(*restored);
      StrainState ahead = state;
      const auto fresh = test_support::make_integrator("exponential");
      math::StateArchive again(words);
      again(*fresh);
      StrainState expected = state;
      const StepEstimate e = restored->step(c.held, c.hand, i * h, share * h, ahead),
                         of_fresh = fresh->step(c.held, c.hand, i * h, share * h, expected);
      EXPECT_EQ(ahead.q, expected.q) << i << " " << share;
      EXPECT_EQ(ahead.q_dot, expected.q_dot) << i << " " << share;
      EXPECT_EQ(e.q_error, of_fresh.q_error) << i << " " << share;
      const HandleState f = c.held.state_at(c.hand, i * h);
      EXPECT_EQ(restored->response(c.held, f, h, ahead).q, fresh->response(c.held, f, h, ahead).q);
    }
    integrator->step(c.held, c.hand, i * h, h, state);
  }
}

}  // namespace
}  // namespace spring_workbench::dynamics::integrator_laws_test
