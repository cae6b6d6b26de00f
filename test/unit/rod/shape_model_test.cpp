#include "spring_workbench/rod/shape_model.h"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>
#include <random>

#include "spring_workbench/math/so3.h"
#include "spring_workbench/rod/straight_rod.h"
#include "spring_workbench/validation/input_error.h"
#include "support/named.h"

namespace spring_workbench::rod::shape_model_test {
namespace {

constexpr double L = 0.3;

StrainVector random_strain(const ShapeModel& shape, std::mt19937& random, double size) {
  std::uniform_real_distribution<double> uniform(-size, size);
  StrainVector q(shape.size());
  for (int i = 0; i < q.size(); ++i) q[i] = uniform(random);
  const bool bushing = shape.extension(StrainVector::Ones(shape.size())) == 1.0;  // a length, not a strain
  if (!bushing) q.head(shape.size() - 1) /= L;
  return q;
}

StrainVector zero(const ShapeModel& shape) { return StrainVector::Zero(shape.size()); }

RigidTransform tip_pose(const ShapeModel& shape, const StrainVector& q) {
  TipKinematics tip;
  shape.tip(q, zero(shape), tip);
  RigidTransform X = RigidTransform::Identity();
  X.linear() = tip.R_HE;
  X.translation() = tip.p_HE;
  return X;
}

class EveryShape : public testing::TestWithParam<std::string> {
 protected:
  std::shared_ptr<const ShapeModel> shape = rod::make_shape_model(test_support::shape_named(GetParam()), L);
  std::mt19937 random{7};
};

TEST_P(EveryShape, UnstrainedRodIsStraight) {
  const RigidTransform X = tip_pose(*shape, zero(*shape));
  EXPECT_LT((X.translation() - L * Vector3d::UnitZ()).norm(), 1e-15);
  EXPECT_LT((X.linear() - Matrix3d::Identity()).norm(), 1e-15);
}

TEST_P(EveryShape, SectionAtTheEndIsTheTip) {
  for (int trial = 0; trial < 50; ++trial) {
    const StrainVector q = random_strain(*shape, random, 0.9);
    const RigidTransform tip = tip_pose(*shape, q), end = shape->section(q, L);
    EXPECT_LT((tip.translation() - end.translation()).norm(), 1e-10 * L);
    EXPECT_LT((tip.linear() - end.linear()).norm(), 1e-9);
  }
}

TEST_P(EveryShape, VelocityAndAccelerationAreDerivativesOfThePose) {
  constexpr double h = 1e-4;
  for (int trial = 0; trial < 50; ++trial) {
    const StrainVector q = random_strain(*shape, random, 0.8), v = random_strain(*shape, random, 0.8);
    const StrainVector a = random_strain(*shape, random, 0.8);
    const auto at = [&](double t) { return StrainVector(q + t * v + 0.5 * t * t * a); };
    TipKinematics tip;
    shape->tip(q, v, tip);
    const RigidTransform X0 = tip_pose(*shape, q);
    // Richardson-extrapolated central differences.
    const auto difference = [&](double step, Vector3d& velocity, Vector3d& acceleration, Vector3d& rate) {
      const RigidTransform Xp = tip_pose(*shape, at(step)), Xm = tip_pose(*shape, at(-step));
      velocity = (Xp.translation() - Xm.translation()) / (2.0 * step);
      acceleration = (Xp.translation() - 2.0 * X0.translation() + Xm.translation()) / (step * step);
      rate = math::log_so3(Xp.linear() * Xm.linear().transpose()) / (2.0 * step);
    };
    Vector3d v1, a1, w1, v2, a2, w2;
    difference(h, v1, a1, w1);
    difference(2.0 * h, v2, a2, w2);
    EXPECT_LT((tip.linear * v - (4.0 * v1 - v2) / 3.0).norm(), 1e-9);
    EXPECT_LT((tip.angular * v - (4.0 * w1 - w2) / 3.0).norm(), 1e-9);
    EXPECT_LT((tip.linear * a + tip.linear_bias - (4.0 * a1 - a2) / 3.0).norm(), 1e-6);
    // Angular acceleration: derivative of the angular velocity along the motion.
    TipKinematics after, before;
    shape->tip(at(h), v + h * a, after);
    shape->tip(at(-h), v - h * a, before);
    const Vector3d alpha = (after.angular * (v + h * a) - before.angular * (v - h * a)) / (2.0 * h);
    EXPECT_LT((tip.angular * a + tip.angular_bias - alpha).norm(), 1e-6);
  }
}

TEST_P(EveryShape, OtherCoordinatesAreOfTheSameTipAndMotionAndStoreNoMore) {
  int changed = 0;
  for (int trial = 0; trial < 50; ++trial) {
    const StrainVector q = random_strain(*shape, random, 3.5), v = random_strain(*shape, random, 1.0);
    StrainVector q1 = q, v1 = v;
    if (!shape->rechart(q1, v1)) continue;
    ++changed;
    TipKinematics before, after;
    shape->tip(q, v, before);
    shape->tip(q1, v1, after);
    EXPECT_LT((before.R_HE - after.R_HE).norm(), 1e-12);
    EXPECT_LT((before.p_HE - after.p_HE).norm(), 1e-12);
    EXPECT_LT((before.angular * v - after.angular * v1).norm(), 1e-11);
    EXPECT_LT((before.linear * v - after.linear * v1).norm(), 1e-12);
    EXPECT_LE(q1.segment(2, 3).norm(), q.segment(2, 3).norm());
  }
  EXPECT_EQ(changed > 5, GetParam() == "bushing");
}

/// Wound up by several turns or not, stretched or compressed.
TEST_P(EveryShape, WithoutBendTheTipIsThatOfAStraightRod) {
  const StraightRod straight(*shape);
  const bool bushing = shape->strain_is_pose();
  std::uniform_real_distribution<double> angle(bushing ? -3.0 : -60.0, bushing ? 3.0 : 60.0), stretch(-0.9, 3.0);
  for (int trial = 0; trial < 50; ++trial) {
    StrainVector q = zero(*shape), v = zero(*shape);
    const int torsion = shape->torsion().begin, stretches = shape->stretch().begin;
    q[torsion] = angle(random) * shape->units()[torsion];
    q[stretches] = stretch(random) * shape->units()[stretches];
    v[torsion] = angle(random);
    v[stretches] = stretch(random);
    TipOf<double> general{}, tip{};
    shape->tip(q.data(), v.data(), general);
    straight.tip(q.data(), tip);
    EXPECT_LT((math::matrix(tip.R_HE, 0) - math::matrix(general.R_HE, 0)).norm(), 1e-9);
    EXPECT_LT(math::vector(tip.p_HE - general.p_HE).norm(), 1e-9 * L);
    for (const int c : {torsion, stretches}) {
      EXPECT_LT(math::vector(tip.angular[c] - general.angular[c]).norm(), 1e-9);
      EXPECT_LT(math::vector(tip.linear[c] - general.linear[c]).norm(), 1e-9 * L);
    }
    EXPECT_LT(math::vector(tip.angular_bias - general.angular_bias).norm(), 1e-8 * v.squaredNorm());
    EXPECT_LT(math::vector(tip.linear_bias - general.linear_bias).norm(), 1e-8 * v.squaredNorm());
  }
}

/// A coordinate that changes by a thousandth of its unit moves the tip by a few thousandths of the length, or turns it
/// by a few milliradians.
TEST_P(EveryShape, UnitsAreOfTheSizeOfTheRod) {
  const StrainVector units = shape->units();
  const RigidTransform rest = tip_pose(*shape, zero(*shape));
  for (int i = 0; i < shape->size(); ++i) {
    const RigidTransform X = tip_pose(*shape, 1e-3 * units[i] * StrainVector::Unit(shape->size(), i));
    const double moved = (X.translation() - rest.translation()).norm() / L,
                 turned = math::log_so3(rest.linear().transpose() * X.linear()).norm();
    EXPECT_GT(moved + turned, 1e-4) << i;
    EXPECT_LT(moved + turned, 2e-3) << i;
  }
}

TEST_P(EveryShape, SmallDeflectionFollowsTheStiffness) {
  // k_bend is transverse tip force over tip deflection, k_torsion moment over twist, k_stretch force over extension.
  const PerDof k{3000.0, 700.0, 9.0};
  const StrainVector K = shape->stiffness(k);
  TipKinematics tip;
  shape->tip(zero(*shape), zero(*shape), tip);
  const StrainVector compliance = K.cwiseInverse();
  const StrainMatrix S = StrainMatrix(compliance.asDiagonal());
  EXPECT_NEAR((tip.linear * S * tip.linear.transpose())(0, 0), 1.0 / k.bend, 1e-12 / k.bend);
  EXPECT_NEAR((tip.linear * S * tip.linear.transpose())(1, 1), 1.0 / k.bend, 1e-12 / k.bend);
  EXPECT_NEAR((tip.linear * S * tip.linear.transpose())(2, 2), 1.0 / k.stretch, 1e-12 / k.stretch);
  EXPECT_NEAR((tip.angular * S * tip.angular.transpose())(2, 2), 1.0 / k.torsion, 1e-12 / k.torsion);
}

TEST_P(EveryShape, WhatIsNotFiniteIsRefusedAndDoesNotComeOutFinite) {
  for (int i = 0; i < shape->size(); ++i) {
    for (const double bad : {std::nan(""), HUGE_VAL, -HUGE_VAL}) {
      StrainVector q = random_strain(*shape, random, 0.5);
      q[i] = bad;
      TipKinematics tip;
      shape->tip(q, zero(*shape), tip);
      EXPECT_FALSE(tip.p_HE.allFinite() && tip.R_HE.allFinite()) << i << " " << bad;
      EXPECT_FALSE(shape->admissible(q)) << i << " " << bad;
    }
  }
}

TEST_P(EveryShape, BadLengthIsRefused) {
  EXPECT_THROW(rod::make_shape_model(test_support::shape_named(GetParam()), 0.0), validation::InputError);
  EXPECT_THROW(rod::make_shape_model(test_support::shape_named(GetParam()), std::nan("")), validation::InputError);
}

INSTANTIATE_TEST_SUITE_P(Shapes, EveryShape, testing::ValuesIn(test_support::shape_names()),
                         [](const auto& instance) { return instance.param; });

TEST(ShapeModel, UnknownNameIsRefusedWithTheKnownOnes) {
  try {
    test_support::shape_named("spaghetti");
    FAIL();
  } catch (const validation::InputError& e) {
    EXPECT_NE(std::string(e.what()).find("spaghetti"), std::string::npos);
    EXPECT_NE(std::string(e.what()).find("linear"), std::string::npos);
  }
}

/// The bushing's stiffness against the slope of its end is what is asked for, its damping in proportion, and by default
/// that of the rod.
TEST(ShapeModel, TheSlopeStiffnessOfABushing) {
  const PerDof k{1000.0, 400.0, 3.0};
  const StrainVector by_default = make_shape_model(ShapeKind::bushing, L)->stiffness(k);
  const auto same = make_shape_model(ShapeKind::bushing, L, 400.0 * L * L / 3.0);
  EXPECT_LT((same->stiffness(k) - by_default).norm(), 1e-12 * by_default.norm());
  const auto set = make_shape_model(ShapeKind::bushing, L, 7.0);
  const StrainVector K = set->stiffness(k), D = set->damping({1.0, 4.0, 0.1}, k);
  for (const int slope : {2, 3}) {
    EXPECT_NEAR(K[slope], 7.0, 1e-12);
    EXPECT_NEAR(D[slope], 0.01 * K[slope], 1e-12);
    EXPECT_EQ(set->damping({1.0, 4.0, 0.1}, PerDof())[slope], 4.0 * L * L / 3.0);
  }
  for (const int other : {0, 1, 4, 5}) EXPECT_EQ(K[other], by_default[other]);
}

/// A small end moment M turns the bushing's tip by M L / EI, as it does the rod with a linear curvature, which is exact
/// there.
TEST(Bushing, AnEndMomentTurnsItAsItDoesTheRod) {
  const PerDof k{2000.0, 500.0, 5.0};
  for (const double length : {0.1, 0.2, 0.7}) {
    const double per_curvature =
        rod::make_shape_model(rod::ShapeKind::linear, length)->stiffness(k)[0];  // ½ K κ², and the angle is κ L
    const StrainVector bushing = rod::make_shape_model(rod::ShapeKind::bushing, length)->stiffness(k);
    for (const int axis : {2, 3}) EXPECT_NEAR(bushing[axis], per_curvature / (length * length), 1e-12 * bushing[axis]);
  }
}

/// The quadrature's nodes change with the strain: where they do, force and energy must not jump.
TEST(StrainRod, TheJacobianIsTheSlopeOfTheTipWithAnyNumberOfNodes) {
  const auto shape = rod::make_shape_model(ShapeKind::linear, L);
  std::mt19937 random(5);
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  for (int trial = 0; trial < 2000; ++trial) {
    StrainVector q = random_strain(*shape, random, 1.0) * std::pow(10.0, uniform(random) - 1.0);
    TipKinematics tip;
    shape->tip(q, zero(*shape), tip);
    for (int i = 0; i < q.size(); ++i) {
      const double h = 3e-4 / L;
      const auto end = [&](double moved) {
        StrainVector other = q;
        other[i] += moved;
        return Vector3d(shape->section(other, L).translation());  // eight nodes
      };
      const Vector3d slope = (8.0 * (end(h) - end(-h)) - end(2.0 * h) + end(-2.0 * h)) / (12.0 * h);
      EXPECT_LT((tip.linear.col(i) - slope).norm(), 1e-10 * L * (i + 1 < q.size() ? L : 1.0)) << q.transpose();
    }
  }
}

TEST(StrainRod, EndMomentRollsItIntoAFullCircle) {
  for (const ShapeKind kind : {ShapeKind::constant, ShapeKind::linear}) {
    const auto shape = rod::make_shape_model(kind, L);
    StrainVector q = zero(*shape);
    q[shape->bend().count / 2] = 2.0 * M_PI / L;
    const RigidTransform X = tip_pose(*shape, q);
    EXPECT_LT(X.translation().norm(), 1e-9 * L);
    EXPECT_LT((X.linear() - Matrix3d::Identity()).norm(), 1e-12);
  }
}

TEST(StrainRod, TipMatchesManyHelices) {
  // A thousand pieces of constant strain each, with Richardson extrapolation of their second-order error.
  const auto shape = rod::make_shape_model(rod::ShapeKind::linear, L);
  std::mt19937 random(3);
  for (int trial = 0; trial < 5; ++trial) {
    const StrainVector q = random_strain(*shape, random, 2.0);
    const auto helices = [&](int n) {
      Matrix3d R = Matrix3d::Identity();
      Vector3d p = Vector3d::Zero();
      const double h = L / n;
      for (int i = 0; i < n; ++i) {
        const double sigma = 2.0 * (i + 0.5) / n - 1.0;
        const Vector3d k(q[0] + sigma * q[1], q[2] + sigma * q[3], q[4]);
        const Matrix3d half = math::exp_so3(0.5 * h * k);
        p += h / 6.0 * (1.0 + q[5]) * (R.col(2) + 4.0 * (R * half).col(2) + (R * half * half).col(2));
        R = R * half * half;
      }
      return p;
    };
    const Vector3d fine = helices(2000), coarse = helices(1000);
    EXPECT_LT((tip_pose(*shape, q).translation() - (4.0 * fine - coarse) / 3.0).norm(), 2e-10 * L);
  }
}

TEST(StrainRod, CentrelineKeepsItsLength) {
  const auto shape = rod::make_shape_model(rod::ShapeKind::linear, L);
  std::mt19937 random(5);
  for (int trial = 0; trial < 10; ++trial) {
    StrainVector q = random_strain(*shape, random, 1.5);
    q[5] = 0.1;
    double length = 0.0;
    constexpr int n = 400;
    for (int i = 0; i < n; ++i) {
      length += (shape->section(q, L * (i + 1) / n).translation() - shape->section(q, L * i / n).translation()).norm();
    }
    EXPECT_NEAR(length, 1.1 * L, 1e-5 * L);
  }
}

TEST(StrainRod, WoundUpOrCrushedIsNotAdmissible) {
  for (const ShapeKind kind : {ShapeKind::constant, ShapeKind::linear}) {
    const auto shape = rod::make_shape_model(kind, L);
    StrainVector q = zero(*shape);
    EXPECT_TRUE(shape->admissible(q));
    q[shape->stretch().begin] = -1.0;
    EXPECT_FALSE(shape->admissible(q));
    q = zero(*shape);
    q[0] = 1000.0 / L;
    EXPECT_FALSE(shape->admissible(q));
    q[0] = std::nan("");
    EXPECT_FALSE(shape->admissible(q));
  }
}

}  // namespace
}  // namespace spring_workbench::rod::shape_model_test
