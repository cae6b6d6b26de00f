#include "spring_workbench/stepping/find_strain.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "support/held_cases.h"
#include "support/named.h"

namespace spring_workbench::stepping::find_strain_test {
namespace {

using dynamics::HeldBody;
using rod::StrainVector;

/// What the springs of a strain lack to a generalised force.
auto lack(const HeldBody& held, const StrainVector& generalised) {
  return
      [&held, generalised](const StrainVector& q) -> StrainVector { return generalised - held.elastic_force(0.0, q); };
}

/// Rods of 1 cm to 10 m and masses of 1 g to 1 t, whose coordinates have forces in different units.
HeldBody random_body(const std::string& shape, std::mt19937& random) {
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  const double length = 0.3 * std::pow(30.0, uniform(random)), mass = std::pow(10.0, 3.0 * uniform(random));
  dynamics::BodyInertia body;
  body.mass = mass;
  body.inertia_O = 0.1 * mass * length * length * Vector3d(0.5, 0.7, 0.9).asDiagonal();
  body.X_OE.translation() = 0.3 * length * Vector3d(uniform(random), uniform(random), uniform(random));
  HeldBody held(rod::make_shape_model(test_support::shape_named(shape), length), body, 9.81);
  held.set_springs({1e3 * mass / length, 3e2 * mass / length, 50.0 * mass * length}, {1.0, 1.0, 1.0});
  return held;
}

TEST(FindStrain, FindsTheStrainOfAnyForceThatTheSpringsExert) {
  std::mt19937 random(4);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  for (const std::string& shape : test_support::shape_names()) {
    for (int trial = 0; trial < 100; ++trial) {
      const HeldBody held = random_body(shape, random);
      StrainVector wanted = held.units();
      for (double& q : wanted) q *= 0.5 * uniform(random);
      const FoundStrain found =
          find_strain(held, 0.0, lack(held, held.elastic_force(0.0, wanted)), StrainVector::Zero(held.size()));
      EXPECT_TRUE(found.found) << shape;
      EXPECT_LT((found.q - wanted).cwiseQuotient(held.units()).norm(), 1e-11) << shape;
    }
  }
}

/// The equilibrium under gravity, where the acceleration is zero; the same in all units.
TEST(FindStrain, FindsTheEquilibriumUnderTheWeight) {
  std::mt19937 random(5);
  for (const std::string& shape : test_support::shape_names()) {
    for (int trial = 0; trial < 100; ++trial) {
      const HeldBody held = random_body(shape, random);
      RigidTransform X_WH = RigidTransform::Identity();
      X_WH.linear() = math::exp_so3(Vector3d(0.5 * trial, 1.0, -0.2 * trial));
      const dynamics::HandleState handle = held.state_at(motion::MotionSegment(X_WH), 0.0);
      const StrainVector rest = StrainVector::Zero(held.size());
      const auto force = [&](const StrainVector& q) -> StrainVector {
        return held.mass_matrix(0.0, q) * held.acceleration(handle, q, rest);
      };
      const FoundStrain found = find_strain(held, 0.0, force, rest);
      EXPECT_TRUE(found.found) << shape << " " << trial;
      const StrainVector a = held.acceleration(handle, found.q, rest);
      EXPECT_LT(held.object(handle, {found.q, rest}, &a).acceleration.linear.norm(), 1e-9) << shape << " " << trial;
    }
  }
}

/// No spring compresses the rod to less than nothing, or exerts a force that always differs from its own.
TEST(FindStrain, SaysWhereThereIsNone) {
  std::mt19937 random(6);
  for (const std::string& shape : test_support::shape_names()) {
    const HeldBody held = random_body(shape, random);
    const StrainVector rest = StrainVector::Zero(held.size());
    const FoundStrain constant = find_strain(
        held, 0.0, [&](const StrainVector& q) { return StrainVector::Ones(q.size()); }, rest);
    EXPECT_FALSE(constant.found);
    EXPECT_EQ(constant.q, rest);
    if (held.shape().strain_is_pose()) continue;
    const StrainVector beyond = -2.0 * StrainVector::Unit(held.size(), held.size() - 1);
    const FoundStrain crushed = find_strain(held, 0.0, lack(held, held.elastic_force(0.0, beyond)), rest);
    EXPECT_FALSE(crushed.found);
    EXPECT_TRUE(held.shape().admissible(crushed.q));
  }
}

}  // namespace
}  // namespace spring_workbench::stepping::find_strain_test
