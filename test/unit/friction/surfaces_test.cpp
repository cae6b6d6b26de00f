#include "spring_workbench/friction/surfaces.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <array>

namespace spring_workbench::friction {
namespace {

using Eigen::Vector3d;
using Jacobian = Eigen::Matrix<double, 3, 6>;

constexpr double duration = 2e-3, compliance = 1e-4, depth = 5e-3;

/// Impulses of two frictionless contacts at the centre of a body that is `depth` deep in the ground at both.
std::array<double, 2> impulses(const Vector3d& n, const Vector3d& other_n, bool* solved) {
  Surfaces surfaces({compliance, 0.0});
  surfaces.begin_step(duration);
  ContactProblem problem;
  const std::array<Vector3d, 2> normals = {n, other_n};
  std::array<int, 2> at;
  for (std::size_t i = 0; i < 2; ++i) at[i] = surfaces.between(0, -1, normals[i], false);
  const std::size_t body = problem.add_body(Eigen::Matrix<double, 6, 6>::Identity());
  surfaces.add_to(problem, true);
  for (std::size_t i = 0; i < 2; ++i) {
    Jacobian J = Jacobian::Zero();
    J.topLeftCorner<1, 3>() = normals[i].transpose();
    problem.add_contact(0.0, -depth / duration * Vector3d::UnitX(), Vector3d::Zero());
    problem.add_part(body, J);
    surfaces.add_part(problem, at[i], normals[i]);
  }
  *solved = problem.solve(1e-9, 1e-9).residual <= 1e-9;
  return {problem.load(0)[0], problem.load(1)[0]};
}

TEST(Surfaces, ABodySqueezedFromTwoSidesIndentsBoth) {
  for (const Vector3d& n : {Vector3d(0.0, 0.0, 1.0), Vector3d(0.36, -0.48, 0.8)}) {
    bool solved = false;
    for (const double impulse : impulses(n, -n, &solved)) EXPECT_NEAR(impulse, duration * depth / compliance, 1e-9);
    EXPECT_TRUE(solved);
  }
}

TEST(Surfaces, ContactsOfOneSideShareItsStiffness) {
  bool solved = false;
  const Vector3d n(0.36, -0.48, 0.8);
  const std::array<double, 2> shared = impulses(n, n, &solved);
  EXPECT_TRUE(solved);
  EXPECT_NEAR(shared[0] + shared[1], depth / duration / (1.0 + compliance / (duration * duration)), 1e-9);
}

TEST(Surfaces, WallsAtARightAngleYieldEachByItself) {
  bool solved = false;
  for (const double impulse : impulses(Vector3d::UnitX(), Vector3d::UnitZ(), &solved)) {
    EXPECT_NEAR(impulse, depth / duration / (1.0 + compliance / (duration * duration)), 1e-9);
  }
  EXPECT_TRUE(solved);
}

}  // namespace
}  // namespace spring_workbench::friction
