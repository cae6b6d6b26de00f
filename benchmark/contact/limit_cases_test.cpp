// Limit cases of contact in both modes: cells of the contact panel of the stability map.
#include "benchmark/contact/limit_cases.h"

#include <gtest/gtest.h>

#include "benchmark/contact/bodies.h"

namespace spring_workbench::benchmark::limit_cases_test {
namespace {

class LimitCases : public ::testing::TestWithParam<scene::ContactMode> {
 protected:
  void run_and_check(ContactLimitCase limit_case, double stiffness, unsigned seed) {
    const LimitCaseOutcome o = run(LimitCaseCell{limit_case, GetParam(), stiffness, 0.02, seed});
    if (limit_case == ContactLimitCase::stack_of_ten) {
      EXPECT_LT(o.pushed, 0.02) << stiffness;  // it stands: the hand goes 0.013 m sideways
    }
    EXPECT_TRUE(o.held()) << name_of(limit_case) << " on " << stiffness << " N/m, seed " << seed << ": "
                          << 1e6 * o.penetration << " µm deep, " << 1e6 * o.energy_gained << " µm gained, "
                          << o.rejected << " rejected";
    EXPECT_EQ(o.steps_blocked, 0) << name_of(limit_case) << ' ' << stiffness << ' ' << seed;
    if (GetParam() == scene::ContactMode::stop) {
      EXPECT_LT(o.penetration, 2.1e-5) << name_of(limit_case) << ' ' << stiffness << ' ' << seed;
    }
  }
};

TEST_P(LimitCases, OnASoftForkAreFiniteBoundedAndGainNoEnergy) {
  for (const ContactLimitCase limit_case : contact_limit_cases()) run_and_check(limit_case, 1e3, 0);
}

TEST_P(LimitCases, AtAWallAreSoOnAnyFork) {
  for (const ContactLimitCase limit_case :
       {ContactLimitCase::light_at_wall, ContactLimitCase::heavy_at_wall, ContactLimitCase::massless_at_wall}) {
    for (const double stiffness : {1.0, 1e6, 1e9}) run_and_check(limit_case, stiffness, 0);
  }
}

INSTANTIATE_TEST_SUITE_P(Modes, LimitCases, ::testing::Values(scene::ContactMode::stop, scene::ContactMode::dynamic),
                         [](const auto& tested) { return name_of(tested.param); });

}  // namespace
}  // namespace spring_workbench::benchmark::limit_cases_test
