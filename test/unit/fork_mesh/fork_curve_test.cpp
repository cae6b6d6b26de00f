#include "spring_workbench/fork_mesh/fork_curve.h"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>

#include "random_strain.h"
#include "spring_workbench/validation/input_error.h"
#include "support/named.h"

namespace spring_workbench::fork_mesh::fork_curve_test {
namespace {

constexpr double pi = 3.14159265358979323846;
constexpr double L = 0.2;

double arc_length(const ForkCurve& curve, double to = 1.0) {
  constexpr int parts = 20000;
  double sum = 0.0;
  Vector3d last = curve.at(0.0).p;
  for (int i = 1; i <= parts; ++i) {
    const Vector3d p = curve.at(to * i / parts).p;
    sum += (p - last).norm();
    last = p;
  }
  return sum;
}

/// A rod with end moments alone, so that it is a circle's arc.
rod::StrainVector circle(const rod::ShapeModel& shape, double angle) {
  rod::StrainVector q = rod::StrainVector::Zero(shape.size());
  q[0] = angle / shape.length();
  return q;
}

TEST(ForkCurve, BothEndAtTheSimulatedTip) {
  test_support::Random random(3);
  for (const char* name : {"constant", "linear"}) {
    const auto shape = rod::make_shape_model(test_support::shape_named(name), L);
    for (int run = 0; run < 200; ++run) {
      const RigidTransform X_WH = random.pose(1.0);
      const rod::StrainVector q = random_strain(*shape, 0.8, random);
      rod::TipKinematics tip;
      shape->tip(q, rod::StrainVector::Zero(shape->size()), tip);
      for (const std::string& curve_name : fork_curve_names()) {
        const ForkCurve curve = make_fork_curve(curve_name, *shape, q, X_WH);
        EXPECT_LT((curve.at(1.0).p - X_WH * tip.p_HE).norm(), 1e-9);
        EXPECT_LT((curve.at(1.0).R - X_WH.linear() * tip.R_HE).norm(), 1e-9);
        EXPECT_LT((curve.end().translation() - X_WH * tip.p_HE).norm(), 1e-9);
        EXPECT_LT((curve.at(0.0).R - X_WH.linear()).norm(), 1e-12);
      }
    }
  }
}

TEST(ForkCurve, TheRodsKeepsItsLengthUnderBending) {
  for (const char* name : {"constant", "linear"}) {
    const auto shape = rod::make_shape_model(test_support::shape_named(name), L);
    for (const double angle : {0.0, 0.5, 2.0, pi, 2.0 * pi}) {
      rod::StrainVector q = circle(*shape, angle);
      EXPECT_NEAR(arc_length(rod_curve(*shape, q, RigidTransform::Identity())), L, 1e-5 * L) << name << " " << angle;
      q[0] = 0.0;
      q[shape->bend().count - 1] = angle / L;  // S-shape of `linear`
      EXPECT_NEAR(arc_length(rod_curve(*shape, q, RigidTransform::Identity())), L, 1e-5 * L) << name << " " << angle;
      q[shape->stretch().begin] = 0.3;
      EXPECT_NEAR(arc_length(rod_curve(*shape, q, RigidTransform::Identity())), 1.3 * L, 1e-5 * L) << angle;
    }
  }
}

TEST(ForkCurve, TheRodsIsTheRodBetweenItsStations) {
  test_support::Random random(4);
  const auto shape = rod::make_shape_model(rod::ShapeKind::linear, L);
  for (int run = 0; run < 200; ++run) {
    const rod::StrainVector q = random_strain(*shape, 1.0, random);
    const ForkCurve curve = rod_curve(*shape, q, RigidTransform::Identity());
    const double u = random.number(0.0, 1.0);
    const RigidTransform exact = shape->section(q, u * L);
    EXPECT_LT((curve.at(u).p - exact.translation()).norm(), 1e-6 * L);
    EXPECT_LT((curve.at(u).R - exact.linear()).norm(), 2e-3);
    EXPECT_LT(curve.at(u).p_rate.normalized().cross(exact.linear().col(2)).norm(), 1e-4);
    EXPECT_NEAR(curve.at(u).p_rate.norm(), L * (1.0 + q[shape->stretch().begin]), 1e-4 * L);
  }
}

TEST(ForkCurve, RatesAreDerivatives) {
  test_support::Random random(5);
  const auto shape = rod::make_shape_model(rod::ShapeKind::linear, L);
  constexpr double d = 1e-6;
  for (int run = 0; run < 100; ++run) {
    const rod::StrainVector q = random_strain(*shape, 0.6, random);
    for (const std::string& name : fork_curve_names()) {
      const ForkCurve curve = make_fork_curve(name, *shape, q, random.pose(1.0));
      const double u = (run % 64 + 0.4) / 64.0;  // between two stations
      const CurvePoint before = curve.at(u - d), at = curve.at(u), after = curve.at(u + d);
      EXPECT_LT((at.p_rate - (after.p - before.p) / (2.0 * d)).norm(), 1e-7);
      const Matrix3d W = at.R.transpose() * (after.R - before.R) / (2.0 * d);
      EXPECT_LT((at.turn_rate - Vector3d(W(2, 1), W(0, 2), W(1, 0))).norm(), 1e-6);
    }
  }
}

TEST(ForkCurve, MovesWithTheHandle) {
  test_support::Random random(6);
  const auto shape = rod::make_shape_model(rod::ShapeKind::linear, L);
  for (int run = 0; run < 50; ++run) {
    const rod::StrainVector q = random_strain(*shape, 0.6, random);
    const RigidTransform X = random.pose(1.0);
    for (const std::string& name : fork_curve_names()) {
      const ForkCurve at_home = make_fork_curve(name, *shape, q, RigidTransform::Identity());
      const ForkCurve moved = make_fork_curve(name, *shape, q, X);
      for (const double u : {0.1, 0.5, 0.77}) {
        EXPECT_LT((moved.at(u).p - X * at_home.at(u).p).norm(), 1e-9);
        EXPECT_LT((moved.at(u).R - X.linear() * at_home.at(u).R).norm(), 1e-6);
      }
    }
  }
}

TEST(BezierCurve, HasTheRodsLengthAndItsStationsAreEvenlySpaced) {
  test_support::Random random(7);
  const auto shape = rod::make_shape_model(rod::ShapeKind::linear, L);
  for (int run = 0; run < 20; ++run) {
    const rod::StrainVector q = random_strain(*shape, 0.4, random);
    const ForkCurve curve = make_fork_curve("bezier", *shape, q, RigidTransform::Identity());
    const double length = L + shape->extension(q);
    EXPECT_NEAR(arc_length(curve), length, 1e-5 * length);
    EXPECT_NEAR(arc_length(curve, 0.3), 0.3 * length, 1e-4 * length);
  }
}

TEST(BezierCurve, IsTheCantileverForSmallDeflections) {
  // Deflection P s² (3 L − s) / 6 EI: curvature falls evenly to nothing at the tip.
  const auto shape = rod::make_shape_model(rod::ShapeKind::linear, L);
  for (const double slope : {1e-6, 1e-3, 0.03}) {
    rod::StrainVector q = rod::StrainVector::Zero(6);
    q[0] = slope / L;
    q[1] = -slope / L;
    const ForkCurve bezier = make_fork_curve("bezier", *shape, q, RigidTransform::Identity());
    const ForkCurve rod = make_fork_curve("rod", *shape, q, RigidTransform::Identity());
    for (const double u : {0.25, 0.5, 0.75}) {
      EXPECT_LT((bezier.at(u).p - rod.at(u).p).norm(), 0.2 * slope * slope * slope * L + 1e-12) << slope;
    }
  }
}

TEST(BezierCurve, SpreadsTorsionEvenlyOverManyTurns) {
  const auto shape = rod::make_shape_model(rod::ShapeKind::linear, L);
  for (const double twist : {-20.0, -3.0, 0.4, 9.0}) {
    rod::StrainVector q = rod::StrainVector::Zero(6);
    q[shape->torsion().begin] = twist / L;
    const ForkCurve curve = make_fork_curve("bezier", *shape, q, RigidTransform::Identity());
    for (const double u : {0.2, 0.5, 0.9}) {
      EXPECT_NEAR(curve.at(u).turn_rate.z(), twist, 1e-6);
      EXPECT_LT((curve.at(u).R - Eigen::AngleAxisd(u * twist, Vector3d::UnitZ()).matrix()).norm(), 1e-6);
    }
  }
}

TEST(BezierCurve, IsFiniteWhereverTheTipIs) {
  test_support::Random random(8);
  for (int run = 0; run < 300; ++run) {
    const ForkCurve curve = bezier_curve(random.pose(1.0), random.pose(1.0), run % 3 == 0 ? 1e-3 : 1.0, 0.0);
    for (const double u : {0.0, 0.3, 1.0}) EXPECT_TRUE(curve.at(u).p.allFinite() && curve.at(u).R.allFinite());
  }
  const ForkCurve circle_end = bezier_curve(RigidTransform::Identity(), RigidTransform::Identity(), L, 0.0);
  EXPECT_TRUE(circle_end.at(0.4).p.allFinite());
}

TEST(ForkCurve, RefusesWhatItDoesNotKnow) {
  const auto shape = rod::make_shape_model(rod::ShapeKind::linear, L);
  EXPECT_THROW(make_fork_curve("spline", *shape, rod::StrainVector::Zero(6), RigidTransform::Identity()),
               validation::InputError);
  EXPECT_THROW(ForkCurve(std::vector<RigidTransform>(4, RigidTransform::Identity())), validation::InputError);
}

}  // namespace
}  // namespace spring_workbench::fork_mesh::fork_curve_test
