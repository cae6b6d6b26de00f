#include <gtest/gtest.h>

#include <random>
#include <vector>

#include "spring_workbench/stepping/step_control.h"
#include "support/count_allocations.h"
#include "support/held_cases.h"
#include "support/named.h"

namespace spring_workbench::stepping::allocation_test {
namespace {

using namespace dynamics;

using test_support::allocations;

class Stepping : public testing::TestWithParam<std::string> {};

TEST(Allocations, AreCounted) {
  if (!COUNTS_ALLOCATIONS) GTEST_SKIP() << "a sanitizer has its own heap";
  const long before = allocations;
  const std::vector<double> some(1000, 1.0);
  EXPECT_GT(allocations, before) << some[0];
}

TEST_P(Stepping, AllocatesNothing) {
  // Whole steps and steps to a tolerance, loads that come and go, a stiffness that changes, motions that need new
  // linear parts.
  for (const std::string& shape : test_support::shape_names()) {
    for (const bool all : {true, false}) {
      for (const double tolerance : {0.0, 1e-3}) {
        std::mt19937 random(3);
        Case c = random_case(shape, 0.3, 0.5, random);
        const rod::StrainVector zero = rod::StrainVector::Zero(c.held.shape().size());
        if (!all) c.held.set_dofs({true, false, false}, 0.0, 0.05, {zero, zero});
        const double m = c.held.body().mass;
        const double h = std::min(0.02, limited_by_stiffness(GetParam()) ? 0.2 / c.omega : 1.0);
        const StepControl control(test_support::make_integrator(GetParam()), tolerance);
        StepControl::Memory memory;
        StrainState state = c.held.zero_state();
        long counted = 0;
        for (int i = 0; i < 12; ++i) {
          if (i == 4) c.held.set_load({m * Vector3d(0.1, 0.2, 0.3), Vector3d::Zero()});
          if (i == 8) c.held.set_springs({2e3 * m, 7e2 * m, 5.0 * m}, {1.0, 1.0, 0.1});
          const long before = allocations;
          control.advance(c.held, c.hand, i * h, h, state, memory);  // a refused step is none the less one
          if (i > 0) counted += allocations - before;
        }
        EXPECT_EQ(counted, 0) << shape << (all ? "" : ", stretch alone") << ", tolerance " << tolerance;
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Integrators, Stepping, testing::ValuesIn(test_support::integrator_names()),
                         [](const auto& instance) { return instance.param; });

}  // namespace
}  // namespace spring_workbench::stepping::allocation_test
