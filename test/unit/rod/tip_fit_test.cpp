#include "spring_workbench/rod/tip_fit.h"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <array>
#include <cmath>
#include <random>

#include "spring_workbench/math/so3.h"

namespace spring_workbench::rod::tip_fit_test {
namespace {

constexpr double L = 0.2;

/// Pose and velocity of a tip.
struct TipMotion {
  RigidTransform X_HE;
  Vector3d v, w;
};

Vector6d scaled(const Vector6d& q) {
  Vector6d s = q;
  s.head<5>() *= L;
  return s;
}

class Linear : public testing::Test {
 protected:
  std::shared_ptr<const ShapeModel> shape = make_shape_model(ShapeKind::linear, L);
  std::mt19937 random{5};

  TipFit<double> fit(const TipMotion& m, const Vector6d& start) const {
    return TipFit<double>(*shape, math::mat3x3(m.X_HE.linear()), math::vec3(m.X_HE.translation()), math::vec3(m.v),
                          math::vec3(m.w), start.data());
  }
  Vector6d strain(double size) {
    std::uniform_real_distribution<double> uniform(-size, size);
    Vector6d q;
    for (int i = 0; i < 6; ++i) q[i] = uniform(random) / (i < 5 ? L : 2.0);
    return q;
  }
  TipMotion tip_of(const Vector6d& q, const Vector6d& q_dot) const {
    TipKinematics tip;
    shape->tip(q, q_dot, tip);
    TipMotion m{RigidTransform::Identity(), tip.linear * q_dot, tip.angular * q_dot};
    m.X_HE.linear() = tip.R_HE;
    m.X_HE.translation() = tip.p_HE;
    return m;
  }
  /// The power of the wrench on the tip equals that of the generalised force on the strain, for any strain.
  void expect_finite_power(const TipFit<double>& found, const TipMotion& m) const {
    Vector6d generalised = scaled(Eigen::Map<const Vector6d>(found.q));
    generalised.head<5>() *= L;
    const Vector6d rate = Eigen::Map<const Vector6d>(found.q_dot);
    double f[6];
    Vector6d::Map(f) = generalised;
    math::Vec3<double> force, moment;
    found.wrench(f, force, moment);
    // No motion of the tip, even a nearly impossible one, requires more than a thousand times as much strain.
    ASSERT_LE(scaled(rate).norm(), 1000.1 * std::hypot(m.v.norm() / L, m.w.norm()));
    ASSERT_NEAR(math::vector(force).dot(m.v) + math::vector(moment).dot(m.w), generalised.dot(rate),
                1e-8 * (generalised.norm() * rate.norm() + 1e-3));
  }
  /// Distance of the fitted tip from the requested pose, relative to the length and in radians.
  static double away(const TipFit<double>& fit, const TipMotion& m) {
    return std::hypot((math::vector(fit.tip.p_HE) - m.X_HE.translation()).norm() / L,
                      math::log_so3(m.X_HE.linear().transpose() * math::matrix(fit.tip.R_HE, 0)).norm());
  }
};

TEST_F(Linear, FindsTheStrainAndItsRateForTheTipsMotion) {
  for (int trial = 0; trial < 200; ++trial) {
    const Vector6d q = strain(0.8), q_dot = strain(3.0), near = q + 0.1 * strain(0.8);
    const TipFit<double> found = fit(tip_of(q, q_dot), near);
    EXPECT_LT((Eigen::Map<const Vector6d>(found.q) - q).norm(), 1e-9);
    EXPECT_LT((Eigen::Map<const Vector6d>(found.q_dot) - q_dot).norm(), 1e-8);
  }
}

/// A path of the tip around and through the handle, up to twice the rod's length away, with rotations beyond half a
/// turn.
struct RandomPath {
  std::array<Vector6d, 3> amplitude;
  explicit RandomPath(std::mt19937& random) {
    std::uniform_real_distribution<double> uniform(-1.0, 1.0);
    for (Vector6d& a : amplitude) {
      for (int i = 0; i < 6; ++i) a[i] = uniform(random) * (i < 3 ? L : 2.0);
    }
  }
  RigidTransform pose(double t) const {
    Vector6d x = Vector6d::Zero();
    for (int k = 0; k < 3; ++k) x += amplitude[static_cast<std::size_t>(k)] * std::sin((k + 1.0) * t);
    RigidTransform X = RigidTransform::Identity();
    X.linear() = math::exp_so3(x.tail<3>());
    X.translation() = L * Vector3d::UnitZ() + x.head<3>();
    return X;
  }
  TipMotion at(double t) const {
    constexpr double h = 1e-5;
    const RigidTransform before = pose(t - h), after = pose(t + h);
    return {pose(t), (after.translation() - before.translation()) / (2.0 * h),
            math::log_so3(after.linear() * before.linear().transpose()) / (2.0 * h)};
  }
};

TEST_F(Linear, FollowsEveryPathOnOneSolutionAndIsFiniteWhereItCannot) {
  constexpr double dt = 0.01;
  int reached = 0, behind = 0, smooth = 0;
  for (int trial = 0; trial < 40; ++trial) {
    const RandomPath path(random);
    Vector6d q = Vector6d::Zero();
    bool was_there = true;
    for (double t = dt; t < 2.0 * M_PI; t += dt) {
      const TipMotion m = path.at(t);
      const TipFit<double> found = fit(m, q);
      const Vector6d next = Eigen::Map<const Vector6d>(found.q);
      ASSERT_TRUE(next.allFinite() && shape->admissible(next));
      expect_finite_power(found, m);
      const bool there = away(found, m) < 1e-8;
      ++(there ? reached : behind);
      const bool went_far = there && was_there && scaled(next - q).norm() > 1.0;
      if (went_far) {
        // It is no further than a hundred short steps lead; where one of these goes far, the solution has ended.
        Vector6d finely = q;
        double longest = 0.0;
        for (int k = 1; k <= 100; ++k) {
          const Vector6d before = finely;
          finely = Eigen::Map<const Vector6d>(fit(path.at(t + (0.01 * k - 1.0) * dt), before).q);
          longest = std::max(longest, scaled(finely - before).norm());
        }
        if (longest < 0.05) {
          ++smooth;
          EXPECT_LT(scaled(finely - next).norm(), 1e-6) << trial << " at " << t;
        }
      }
      q = next;
      was_there = there;
    }
  }
  EXPECT_GT(reached, 100 * behind);
  EXPECT_GT(behind, 0);  // there are such poses
  EXPECT_GT(smooth, 0);
}

TEST_F(Linear, RatesAndWrenchesAreFiniteWhereTheTipCannotMove) {
  const auto slope = [&](const Vector6d& q) {
    TipKinematics tip;
    shape->tip(q, Vector6d::Zero(), tip);
    Matrix6d J;
    J << tip.linear / L, tip.angular;
    return J.determinant();
  };
  int found = 0;
  for (int trial = 0; trial < 200; ++trial) {
    const Vector6d way = strain(0.5);
    double before = 0.0, behind = 0.0;
    for (double s = 0.5; s < 12.0 && behind == 0.0; s += 0.5) {
      if (!shape->admissible(s * way)) break;
      (slope(s * way) * slope(Vector6d::Zero()) > 0.0 ? before : behind) = s;
    }
    if (behind == 0.0) continue;
    for (int k = 0; k < 60; ++k) {
      const double s = 0.5 * (before + behind);
      (slope(s * way) * slope(Vector6d::Zero()) > 0.0 ? before : behind) = s;
    }
    TipMotion m = tip_of(before * way, Vector6d::Zero());
    m.v = strain(1.0).head<3>();
    m.w = strain(1.0).head<3>();
    expect_finite_power(fit(m, before * way), m);
    ++found;
  }
  EXPECT_GT(found, 20);
}

TEST_F(Linear, ATipPushedThroughItsHandleStaysBehindAndComesBackAsItWent) {
  Vector6d q = Vector6d::Zero();
  const auto at = [&](double z) {
    TipMotion m{RigidTransform::Identity(), -Vector3d::UnitZ(), Vector3d::Zero()};
    m.X_HE.translation() = z * L * Vector3d::UnitZ();
    return m;
  };
  const auto go = [&](double z) {
    const TipFit<double> found = fit(at(z), q);
    q = Eigen::Map<const Vector6d>(found.q);
    return away(found, at(z));
  };
  for (double z = 1.0; z > 0.03; z -= 0.01) EXPECT_LT(go(z), 1e-12) << z;
  for (double z = 0.01; z > -0.2; z -= 0.01) EXPECT_NEAR(go(z), 0.02 - z, 1e-6) << z;
  EXPECT_NEAR(q[5], -0.98, 1e-6);
  for (double z = -0.2; z < 0.01; z += 0.01) EXPECT_NEAR(go(z), 0.02 - z, 1e-6) << z;
  for (double z = 0.03; z < 1.005; z += 0.01) EXPECT_LT(go(z), 1e-12) << z;
  EXPECT_LT(q.norm(), 1e-9);
}

TEST_F(Linear, SeveralAtOnceAreEachByItself) {
  for (int trial = 0; trial < 50; ++trial) {
    const RandomPath path(random);
    math::Pack q[6] = {};
    std::array<Vector6d, 4> each;
    each.fill(Vector6d::Zero());
    for (double t = 0.1; t < 6.0; t += 0.1) {
      math::Mat3x3<math::Pack> R;
      math::Vec3<math::Pack> p, v, w;
      for (int l = 0; l < 4; ++l) {
        const TipMotion m = path.at(t + 0.3 * l);
        math::set_lane(R, l, math::mat3x3(m.X_HE.linear()));
        math::set_lane(p, l, math::vec3(m.X_HE.translation()));
        math::set_lane(v, l, math::vec3(m.v));
        math::set_lane(w, l, math::vec3(m.w));
      }
      const TipFit<math::Pack> all(*shape, R, p, v, w, q);
      for (int l = 0; l < 4; ++l) {
        Vector6d& own = each[static_cast<std::size_t>(l)];
        const TipFit<double> alone = fit(path.at(t + 0.3 * l), own);
        const double size = 1.0 + scaled(Eigen::Map<const Vector6d>(alone.q)).norm();
        for (int i = 0; i < 6; ++i) {
          own[i] = alone.q[i];
          EXPECT_NEAR(math::lane(all.q[i], l), alone.q[i], 1e-6 * size / L) << trial << " " << t;
          math::set_lane(q[i], l, own[i]);
        }
      }
    }
  }
}

}  // namespace
}  // namespace spring_workbench::rod::tip_fit_test
