#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <random>

#include "spring_workbench/dynamics/integrator.h"
#include "support/held_cases.h"
#include "support/named.h"

namespace spring_workbench::dynamics::integrator_laws_test {
namespace {

StrainState carried(Integrator& integrator, const Case& c, double t, double h, int steps, StrainState state) {
  for (int i = 0; i < steps; ++i) integrator.step(c.held, c.hand, t + i * h, h, state);
  return state;
}

/// At 0.2 s by the classical Runge–Kutta method at a fine step; made once for each rod.
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

TEST_P(EveryIntegrator, EstimatesItsLocalErrorWithinAFactorOfTenInNineStepsOfTen) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  int within = 0, all = 0;
  for (int trial = 0; trial < 60; ++trial) {
    const double zeta = trial % 3 == 0 ? 0.1 : trial % 3 == 1 ? 1.0 : 3.0;
    const std::string shape =
        test_support::shape_names()[static_cast<std::size_t>(trial) % test_support::shape_names().size()];
    const Case c = random_case(shape, zeta, 1.0, random);
    // Steps from well resolved to, where the method can, stiff.
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

INSTANTIATE_TEST_SUITE_P(Integrators, EveryIntegrator,
                         testing::ValuesIn(test_support::equation_of_motion_integrator_names()),
                         [](const auto& instance) { return instance.param; });

}  // namespace
}  // namespace spring_workbench::dynamics::integrator_laws_test
