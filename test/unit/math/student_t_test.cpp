#include "spring_workbench/math/student_t.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace spring_workbench::math::student_t_test {
namespace {

constexpr double pi = 3.14159265358979323846;

TEST(StudentT, HasTheClosedFormsOfOneAndTwoDegreesOfFreedom) {
  for (const double p : {0.6, 0.9, 0.975, 0.999}) {
    EXPECT_NEAR(student_t_quantile(1.0, p) / std::tan(pi * (p - 0.5)), 1.0, 1e-12);
    const double a = 4.0 * p * (1.0 - p);
    EXPECT_NEAR(student_t_quantile(2.0, p) / (2.0 * (p - 0.5) * std::sqrt(2.0 / a)), 1.0, 1e-12);
  }
}

TEST(StudentT, IsSymmetricAndTendsToTheNormalDistribution) {
  EXPECT_NEAR(student_t_quantile(7.0, 0.1), -student_t_quantile(7.0, 0.9), 1e-12);
  const double normal = student_t_quantile(std::numeric_limits<double>::infinity(), 0.975);
  EXPECT_NEAR(0.5 * std::erfc(-normal / std::sqrt(2.0)), 0.975, 1e-12);
  EXPECT_NEAR(student_t_quantile(1e9, 0.975), normal, 1e-8);
}

}  // namespace
}  // namespace spring_workbench::math::student_t_test
