#include "spring_workbench/validation/renamed.h"

#include <gtest/gtest.h>

namespace spring_workbench::validation::renamed_test {
namespace {

const std::vector<std::string> few{"friction", "restitution", "density"};
const std::vector<std::string> many{"contact", "defaults", "force_scale", "gravity", "objects",
                                    "start",   "step",     "targets",     "tool"};

TEST(UnknownKey, IsComparedWithTheNearestOfManyKeys) {
  EXPECT_EQ(unknown_key("gravty", many), "unknown key; did you mean gravity?");
  EXPECT_EQ(unknown_key("forcescale", many), "unknown key; did you mean force_scale?");
  EXPECT_EQ(unknown_key("obejcts", many), "unknown key; did you mean objects?") << "two letters exchanged";
  EXPECT_EQ(unknown_key("steps", many), "unknown key; did you mean step?");
  EXPECT_EQ(unknown_key("friction", many),
            "unknown key; known keys are contact, defaults, force_scale, gravity, objects, start, step, targets, tool");
}

TEST(UnknownKey, OfFewKeysOrNoneIsFollowedByAll) {
  EXPECT_EQ(unknown_key("densty", few), "unknown key; known keys are friction, restitution, density");
  EXPECT_EQ(unknown_key("densty", {}), "unknown key; known keys are ");
}

TEST(UnknownKey, OfAnEarlierVersionIsFollowedByItsNewName) {
  EXPECT_EQ(unknown_key("fork.breakaway_force", many), "unknown key; it is now called limit.force");
}

}  // namespace
}  // namespace spring_workbench::validation::renamed_test
