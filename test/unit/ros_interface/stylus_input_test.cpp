#include "spring_workbench/ros_interface/stylus_input.h"

#include <gtest/gtest.h>

#include <limits>

namespace spring_workbench {
namespace {

geometry_msgs::TransformStamped transform(double x, double qx, double qy, double qz, double qw) {
  geometry_msgs::TransformStamped result;
  result.header.frame_id = "workbench";
  result.child_frame_id = "stylus";
  result.transform.translation.x = x;
  result.transform.rotation.x = qx;
  result.transform.rotation.y = qy;
  result.transform.rotation.z = qz;
  result.transform.rotation.w = qw;
  return result;
}

TEST(FindFault, LetsEveryRotationPass) {
  EXPECT_FALSE(find_fault(transform(1.0, 0, 0, 0, 1)));
  EXPECT_FALSE(find_fault(transform(-1e6, 0.5, -0.5, 0.5, -0.5)));
  EXPECT_FALSE(find_fault(transform(0.0, 0, 0, 0, 0.99)));  // rounded by whoever sent it
}

TEST(FindFault, NamesFrameFieldValueAndRuleInOneLine) {
  constexpr double nan = std::numeric_limits<double>::quiet_NaN(), inf = std::numeric_limits<double>::infinity();
  struct Case {
    geometry_msgs::TransformStamped transform;
    std::string reason, field, value;
  };
  const std::vector<Case> cases{{transform(nan, 0, 0, 0, 1), "not finite", "translation", "nan"},
                                {transform(inf, 0, 0, 0, 1), "not finite", "translation", "inf"},
                                {transform(0, nan, 0, 0, 1), "not finite", "rotation", "nan"},
                                {transform(0, 0, inf, 0, 1), "not finite", "rotation", "inf"},
                                {transform(1e10, 0, 0, 0, 1), "too far", "translation", "1e+10"},
                                {transform(0, 0, 0, 0, 0), "zero quaternion", "rotation", "(0, 0, 0, 0)"}};
  for (const Case& c : cases) {
    const auto fault = find_fault(c.transform);
    ASSERT_TRUE(fault);
    EXPECT_EQ(fault->reason, c.reason);
    for (const std::string& word : {std::string("workbench -> stylus"), c.field, c.value, std::string("must be")}) {
      EXPECT_NE(fault->line.find(word), std::string::npos) << fault->line;
    }
    EXPECT_EQ(fault->line.find('\n'), std::string::npos);
  }
}

}  // namespace
}  // namespace spring_workbench
