#include "spring_workbench/bodies/body_pair.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <random>

#include "spring_workbench/math/so3.h"

namespace spring_workbench::bodies::body_pair_test {
namespace {

class RandomPair {
 public:
  explicit RandomPair(unsigned seed) : random_(seed) {
    for (scene::Body& b : bodies_) {
      b.mass_properties.mass = std::exp(3.0 * unit_(random_));
      const Vector3d semi = 0.1 * (2.0 * Vector3d::Ones() + vector());
      const Matrix3d R = math::exp_so3(3.0 * vector());
      const Vector3d principal =
          b.mass_properties.mass / 5.0 * (semi.squaredNorm() * Vector3d::Ones() - semi.cwiseAbs2());
      b.mass_properties.inertia_O = R * principal.asDiagonal() * R.transpose();
    }
  }
  Vector3d vector() { return {unit_(random_), unit_(random_), unit_(random_)}; }
  Wrench wrench() { return {vector(), 0.1 * vector()}; }
  FreeBody body(std::size_t i) {
    RigidTransform X(Eigen::Translation3d(0.3 * vector()));
    X.linear() = math::exp_so3(3.0 * vector());
    return FreeBody(i, bodies_[i], 0.0, X, {vector(), 5.0 * vector()});
  }
  BodyPair pair() {
    FreeBody first = body(0), second = body(1);
    return BodyPair(first, second);
  }
  /// Momentum, angular momentum about the origin, energy.
  Eigen::Matrix<double, 7, 1> invariants(const BodyPair& pair) const {
    Eigen::Matrix<double, 7, 1> sum = Eigen::Matrix<double, 7, 1>::Zero();
    for (const FreeBody* body : {&pair.first(), &pair.second()}) {
      const motion::MotionState s = body->object();
      const scene::MassProperties& m = bodies_[body->index()].mass_properties;
      const Vector3d p = m.mass * s.velocity.linear;
      const Vector3d L = s.X.linear() * m.inertia_O * s.X.linear().transpose() * s.velocity.angular;
      sum.head<3>() += p;
      sum.segment<3>(3) += s.X.translation().cross(p) + L;
      sum[6] += 0.5 * (p.dot(s.velocity.linear) + L.dot(s.velocity.angular));
    }
    return sum;
  }

 private:
  std::mt19937 random_;
  std::uniform_real_distribution<double> unit_{-1.0, 1.0};
  std::array<scene::Body, 2> bodies_;
};

TEST(BodyPair, LoadsAndImpulsesKeepMomentumAndAngularMomentum) {
  for (unsigned seed = 0; seed < 100; ++seed) {
    RandomPair random(seed);
    BodyPair pair = random.pair();
    const auto before = random.invariants(pair);
    for (int i = 0; i < 10; ++i) {
      const double h = 0.02;
      ASSERT_TRUE(pair.advance(h, random.wrench()));
      pair.correct(h, random.wrench());
      pair.add_impulse(random.wrench());
      pair.accept();
    }
    EXPECT_LT((random.invariants(pair) - before).head<6>().norm(), 1e-12) << seed;
    const double fastest = to_vector(pair.object().velocity).norm();
    pair.block(0.01);
    EXPECT_LT((random.invariants(pair) - before).head<6>().norm(), 1e-12) << seed;
    EXPECT_LT(to_vector(pair.object().velocity).norm(), 1e-10 * fastest) << seed;
  }
}

TEST(BodyPair, AnImpulseChangesTheEnergyLikeThatOfOneBody) {
  for (unsigned seed = 0; seed < 100; ++seed) {
    RandomPair random(seed);
    BodyPair pair = random.pair();
    ASSERT_TRUE(pair.advance(0.05, {}));
    const double before = random.invariants(pair)[6];
    const Vector6d v = to_vector(pair.object().velocity), by_one = to_vector(random.wrench());
    const Matrix6d mobility = pair.mobility();
    pair.add_impulse(to_wrench(by_one));
    EXPECT_LT((to_vector(pair.object().velocity) - v - mobility * by_one).norm(), 1e-12) << seed;
    EXPECT_NEAR(random.invariants(pair)[6] - before, by_one.dot(v) + 0.5 * by_one.dot(mobility * by_one), 1e-12)
        << seed;
  }
}

TEST(BodyPair, ItsVelocityIsTheRateOfItsPose) {
  for (unsigned seed = 0; seed < 100; ++seed) {
    RandomPair random(seed);
    BodyPair pair = random.pair();
    ASSERT_TRUE(pair.advance(0.05, {}));
    const double h = 1e-4;
    BodyPair later = pair, sooner = pair;
    ASSERT_TRUE(later.advance(h, {}) && sooner.advance(-h, {}));
    const motion::MotionState s = pair.object();
    const RigidTransform X0 = sooner.object().X, X1 = later.object().X;
    const Vector3d turned = X0.linear() * math::turn_between(X0, X1);
    EXPECT_LT(((X1.translation() - X0.translation()) / (2.0 * h) - s.velocity.linear).norm(), 1e-5) << seed;
    EXPECT_LT((turned / (2.0 * h) - s.velocity.angular).norm(), 1e-2) << seed;
    EXPECT_TRUE((pair.X_WF() * s.X).isApprox(pair.first().object().X, 1e-12)) << seed;
  }
}

// The load of a substep moves the end of it as the response says.
TEST(BodyPair, ItsResponseIsThatOfItsMotion) {
  for (unsigned seed = 0; seed < 100; ++seed) {
    RandomPair random(seed);
    BodyPair free = random.pair(), loaded = free;
    const double h = 1e-4;
    const Wrench load = random.wrench();
    const Vector6d by_response = free.response(h).displacement * to_vector(load);
    ASSERT_TRUE(free.advance(h, {}) && loaded.advance(h, load));
    const RigidTransform X0 = free.object().X, X1 = loaded.object().X;
    Vector6d moved;
    moved << X1.translation() - X0.translation(), X0.linear() * math::turn_between(X0, X1);
    EXPECT_LT((moved - by_response).norm(), 0.01 * by_response.norm()) << seed;
  }
}

}  // namespace
}  // namespace spring_workbench::bodies::body_pair_test
