// Limit cases of contact in both modes: cells of the contact panel of the stability map.
#include "benchmark/contact/extremes.h"

#include <gtest/gtest.h>

#include "benchmark/contact/bodies.h"

namespace spring_workbench::benchmark::extremes_test {
namespace {

class Extremes : public ::testing::TestWithParam<scene::ContactMode> {
 protected:
  void run_and_check(ContactExtreme extreme, double stiffness, unsigned seed) {
    const ExtremeOutcome o = run(ExtremeCell{extreme, GetParam(), stiffness, 0.02, seed});
    if (extreme == ContactExtreme::stack_of_ten) {
      EXPECT_LT(o.pushed, 0.02) << stiffness;  // it stands: the hand goes 0.013 m sideways
    }
    EXPECT_TRUE(o.held()) << name_of(extreme) << " on " << stiffness << " N/m, seed " << seed << ": "
                          << 1e6 * o.penetration << " µm deep, " << 1e6 * o.energy_gained << " µm gained, " << o.refused
                          << " refused";
    EXPECT_EQ(o.steps_blocked, 0) << name_of(extreme) << ' ' << stiffness << ' ' << seed;
    if (GetParam() == scene::ContactMode::stop) {
      EXPECT_LT(o.penetration, 2.1e-5) << name_of(extreme) << ' ' << stiffness << ' ' << seed;
    }
  }
};

TEST_P(Extremes, OnASoftForkAreFiniteBoundedAndGainNoEnergy) {
  for (const ContactExtreme extreme : contact_extremes()) run_and_check(extreme, 1e3, 0);
}

TEST_P(Extremes, AtAWallAreSoOnAnyFork) {
  for (const ContactExtreme extreme :
       {ContactExtreme::light_at_wall, ContactExtreme::heavy_at_wall, ContactExtreme::massless_at_wall}) {
    for (const double stiffness : {1.0, 1e6, 1e9}) run_and_check(extreme, stiffness, 0);
  }
}

INSTANTIATE_TEST_SUITE_P(Modes, Extremes, ::testing::Values(scene::ContactMode::stop, scene::ContactMode::dynamic),
                         [](const auto& tested) { return name_of(tested.param); });

}  // namespace
}  // namespace spring_workbench::benchmark::extremes_test
