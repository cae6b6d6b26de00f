#include "spring_workbench/hand_input/reacquisition.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "spring_workbench/math/so3.h"

namespace spring_workbench::hand_input::reacquisition_test {
namespace {

constexpr double kNever = -std::numeric_limits<double>::infinity();
constexpr double kInterval = 1.0 / 120.0;

double angle(const RigidTransform& a, const RigidTransform& b) {
  return math::log_so3(a.linear().transpose() * b.linear()).norm();
}
double distance(const RigidTransform& a, const RigidTransform& b) { return (a.translation() - b.translation()).norm(); }

TEST(Reacquisition, AHandThatIsNeverLostIsFollowedToTheBit) {
  srand(1);
  Reacquisition hand{InputSettings()};
  for (int k = 0; k < 100; ++k) {
    const motion::PoseSample sample{kInterval * k, make_transform(Vector3d::Random(), Quaterniond::UnitRandom())};
    const auto followed = hand.follow(sample, k == 0, kNever);
    ASSERT_EQ(followed.size(), 1u);
    EXPECT_EQ(followed[0].t, sample.t);
    EXPECT_EQ(followed[0].X.matrix(), sample.X.matrix());
  }
  EXPECT_EQ(hand.counts().reacquisitions, 0u);
}

/// A hand that moves and turns at constant rates.
struct EvenHand {
  RigidTransform X_0;
  Vector3d v, w;
  motion::PoseSample at(double t) const {
    motion::PoseSample sample{t, X_0};
    sample.X.translation() += t * v;
    sample.X.linear() = X_0.linear() * math::exp_so3(t * w);
    return sample;
  }
};

TEST(Reacquisition, SetsOutWhereItWasHeldAtRestWithinTheSpeedsAndArrivesExactly) {
  srand(1);
  for (int run = 0; run < 100; ++run) {
    InputSettings settings;
    settings.reacquisition_speed = 0.4;
    settings.reacquisition_turn_rate = 1.5;
    Reacquisition hand(settings);
    const motion::PoseSample held{0.0, make_transform(Vector3d::Random(), Quaterniond::UnitRandom())};
    hand.follow(held, true, kNever);
    const double v = 0.3, w = 2.0;  // of the hand that is back
    EvenHand back{make_transform(2.0 * Vector3d::Random(), Quaterniond::UnitRandom()),
                  v * Vector3d::Random().normalized(), w * Vector3d::Random().normalized()};
    RigidTransform before = held.X;
    bool arrived = false;
    for (int k = 0; k < 12000 && !arrived; ++k) {
      const motion::PoseSample sample = back.at(1.0 + k * kInterval);
      const auto followed = hand.follow(sample, k == 0, kNever);
      ASSERT_EQ(followed.size(), 1u);
      if (k == 0) {
        EXPECT_LT(distance(followed[0].X, held.X) + angle(followed[0].X, held.X), 1e-9);
      }
      EXPECT_LT(distance(followed[0].X, before), kInterval * (settings.reacquisition_speed + v) * (1.0 + 1e-9));
      EXPECT_LT(angle(followed[0].X, before), kInterval * (settings.reacquisition_turn_rate + w) * (1.0 + 1e-9));
      before = followed[0].X;
      arrived = followed[0].X.matrix() == sample.X.matrix();
    }
    EXPECT_TRUE(arrived);
    EXPECT_EQ(hand.counts().reacquisitions, 1u);
  }
}

/// Half of the speed after half of the ramp; distance divided by e after each time constant; the last 10 µm, or 0.1
/// mrad, at once.
TEST(Reacquisition, ComesInOverItsRampAndArrivesWithItsTimeConstant) {
  constexpr double ramp = 0.2, tail = 0.1, h = 1e-4;
  for (const bool turns : {false, true}) {
    InputSettings settings;
    const double speed = turns ? settings.reacquisition_turn_rate : settings.reacquisition_speed;
    Reacquisition hand(settings);
    hand.follow({0.0, RigidTransform::Identity()}, true, kNever);
    const RigidTransform goal = turns ? make_transform(Vector3d::Zero(), Quaterniond(math::exp_so3(Vector3d(0, 0, 1))))
                                      : make_transform(Vector3d(1, 0, 0), Quaterniond::Identity());
    const auto left = [&](const RigidTransform& X) { return turns ? angle(X, goal) : distance(X, goal); };
    double before = 1.0, nearest = 1.0, entered = 0.0;
    bool ramp_seen = false, tail_seen = false;
    for (int k = 0; nearest > 0.0; ++k) {
      ASSERT_LT(k, 100000);
      const double now = left(hand.follow({1.0 + k * h, goal}, k == 0, kNever)[0].X);
      if (k == std::lround(0.5 * ramp / h)) {
        EXPECT_NEAR((before - now) / h, 0.5 * speed, 1e-2 * speed);
        ramp_seen = true;
      }
      if (now < 0.5 * speed * tail && entered == 0.0) entered = k * h + tail * std::log(now / (0.05 * speed * tail));
      if (entered > 0.0 && k == std::lround(entered / h)) {
        EXPECT_NEAR(now, 0.05 * speed * tail, 1e-3 * speed * tail);
        tail_seen = true;
      }
      before = now;
      if (now > 1e-12) nearest = now;
      if (now <= 1e-12) break;
    }
    EXPECT_TRUE(ramp_seen && tail_seen);
    EXPECT_NEAR(nearest, turns ? 1e-4 : 1e-5, turns ? 2e-6 : 2e-7);
  }
}

TEST(Reacquisition, TheFirstStepIsOfThirdOrder) {  // at rest, and without a kick
  double last = 0.0;
  for (const double h : {0.02, 0.01, 0.005}) {
    Reacquisition hand{InputSettings()};
    hand.follow({0.0, RigidTransform::Identity()}, true, kNever);
    const motion::PoseSample elsewhere{1.0, make_transform(Vector3d(1, 0, 0), Quaterniond::Identity())};
    hand.follow(elsewhere, true, kNever);
    const double moved = hand.follow({1.0 + h, elsewhere.X}, false, kNever)[0].X.translation().x();
    if (last > 0.0) {
      EXPECT_NEAR(last / moved, 8.0, 0.4);
    }
    last = moved;
  }
}

TEST(Reacquisition, SamplesWhoseTimeIsSimulatedComeTooLate) {
  Reacquisition hand{InputSettings()};
  const RigidTransform X = RigidTransform::Identity();
  hand.follow({0.0, X}, true, kNever);
  hand.follow({0.1, X}, false, 0.0);
  for (const double t : {0.2, 0.5, 1.9, 2.0}) EXPECT_TRUE(hand.follow({t, X}, false, 2.0).empty());
  const auto followed = hand.follow({2.1, make_transform(Vector3d(1, 2, 3), Quaterniond::Identity())}, false, 2.0);
  ASSERT_EQ(followed.size(), 2u);
  EXPECT_EQ(followed[0].t, 2.0);
  EXPECT_EQ(followed[1].t, 2.1);
  for (const motion::PoseSample& s : followed) EXPECT_LT(distance(s.X, X), 1e-12);
  EXPECT_EQ(hand.counts().late, 4u);
  EXPECT_EQ(hand.counts().reacquisitions, 1u);
}

TEST(Reacquisition, ALostHandReleasesOnceOrNever) {
  for (const OnLoss on_loss : {OnLoss::freeze, OnLoss::release}) {
    InputSettings settings;
    settings.on_loss = on_loss;
    settings.loss_timeout = 1.5;
    Reacquisition hand(settings);
    EXPECT_FALSE(hand.take_release(1e9));
    const RigidTransform X = RigidTransform::Identity();
    hand.follow({0.0, X}, true, kNever);
    EXPECT_FALSE(hand.take_release(1.49));
    EXPECT_EQ(hand.counts().losses, 0u);
    const auto release = hand.take_release(10.0);  // live: the silence goes on
    EXPECT_EQ(release.has_value(), on_loss == OnLoss::release);
    if (release) {
      EXPECT_EQ(*release, 1.5);
    }
    EXPECT_FALSE(hand.take_release(20.0));
    hand.follow({30.0, X}, true, 20.0);
    hand.follow({40.0, X}, true, kNever);  // a gap that is known before it is simulated
    hand.follow({40.1, X}, false, kNever);
    EXPECT_FALSE(hand.take_release(31.4));
    const auto second = hand.take_release(40.0);
    EXPECT_EQ(second.has_value(), on_loss == OnLoss::release);
    if (second) {
      EXPECT_EQ(*second, 31.5);
    }
    EXPECT_EQ(hand.counts().losses, 2u);
  }
}

TEST(Reacquisition, MoreThanOneTurnAwayIsCaughtUpWithoutAJump) {
  InputSettings settings;
  Reacquisition hand(settings);
  hand.follow({0.0, RigidTransform::Identity()}, true, kNever);
  EvenHand back{make_transform(Vector3d(3, 0, 0), Quaterniond::Identity()), Vector3d::Zero(), Vector3d(0, 0, 3.0)};
  RigidTransform before = RigidTransform::Identity();
  int steps = 0;
  do {
    before = hand.follow(back.at(1.0 + steps * kInterval), steps == 0, kNever)[0].X;
    const RigidTransform next = hand.follow(back.at(1.0 + (steps + 0.5) * kInterval), false, kNever)[0].X;
    ASSERT_LT(angle(before, next), kInterval * (settings.reacquisition_turn_rate + 3.0));
    ++steps;
  } while (steps < 5000);
  EXPECT_LT(angle(before, back.at(1.0 + (steps - 1) * kInterval).X), 1e-9);
  EXPECT_EQ(hand.follow(back.at(100.0), false, kNever)[0].X.matrix(), back.at(100.0).X.matrix());
}

}  // namespace
}  // namespace spring_workbench::hand_input::reacquisition_test
