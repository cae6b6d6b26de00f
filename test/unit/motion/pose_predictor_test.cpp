#include "spring_workbench/motion/pose_predictor.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <utility>

#include "spring_workbench/math/so3.h"
#include "spring_workbench/motion/pose_track.h"

namespace spring_workbench::motion::pose_predictor_test {
namespace {

PoseSample at(double t, const Vector3d& p, double turned) {
  return {t, make_transform(p, Quaterniond(math::exp_so3(Vector3d(0.0, turned, 0.0))))};
}

const Vector3d v(0.3, -0.2, 0.1), a(2.0, 1.0, -3.0);
PoseSample on_line(double t) { return at(t, t * v, 0.5 * t); }
PoseSample on_parabola(double t) { return at(t, t * v + t * t * a, 0.4 * t + 0.9 * t * t); }

/// Lines and parabolas are continued exactly, also by a track that is given the predicted samples.
TEST(PosePredictor, FollowsLineAndParabolaExactly) {
  for (const auto& motion : {on_line, on_parabola}) {
    PosePredictor predictor;
    PoseTrack track;
    for (int k = 0; k <= 75; ++k) {
      predictor.push(motion(0.008 * k));
      track.push(motion(0.008 * k));
    }
    for (const double ahead : {0.001, 0.005, 0.019, 0.05, 0.09}) {
      const double t = 0.6 + ahead;
      EXPECT_LT((predictor.predict(t)->X.matrix() - motion(t).X.matrix()).norm(), 1e-7) << ahead;
      EXPECT_EQ(predictor.predict(t)->t, t);
      PoseTrack continued = track;
      for (const PoseSample& sample : predictor.continuation(t)) EXPECT_TRUE(continued.push(sample));
      EXPECT_GT(continued.end(), t);
      EXPECT_LE(continued.end(), 0.6 + PosePredictor::farthest);
      for (double s = 0.592; s <= t; s += 0.0011) {
        EXPECT_LT((continued.pose(s).matrix() - motion(s).X.matrix()).norm(), 1e-6) << s;
      }
    }
  }
}

/// Up to the time of another stream's sample: no predicted sample differs from it only by a rounding error.
TEST(PosePredictor, GoesOnToExactlyTheGivenTime) {
  int exact = 0;
  for (const double interval : {0.01, 1.0 / 60.0, 1.0 / 120.0}) {
    PosePredictor predictor;
    for (int k = 0; k < 500; ++k) {
      predictor.push(on_line(interval * k));
      for (const int further : {1, 2, 3}) {
        const double t = interval * (k + further);
        for (const PoseSample& sample : predictor.continuation(t)) {
          EXPECT_TRUE(sample.t == t || std::abs(sample.t - t) > 1e-4) << sample.t - t;
          exact += sample.t == t ? 1 : 0;
        }
      }
    }
  }
  EXPECT_EQ(exact, 3 * 499 * 3);
}

/// After a corner, the prediction is along the new line once the corner is older than the window, and not before. Its
/// length is that of a mean with the newest pose, whose weight decreases.
TEST(PosePredictor, ForgetsWhatIsOlderThanItsWindow) {
  const auto corner = [](double t) { return at(t, Vector3d(t, std::max(0.0, t - 0.4), 0.0), 0.0); };
  PosePredictor predictor;
  for (int k = 0; k <= 200; ++k) {
    const double t = 0.005 * k;
    predictor.push(corner(t));
    if (t < 0.42) continue;
    const Vector3d change = predictor.predict(t + 0.02)->X.translation() - corner(t).X.translation();
    const double off = std::abs(change.x() - change.y());
    if (t < 0.6) {
      EXPECT_GT(off, 1e-7) << t;
    }
    if (t > 0.89) {
      EXPECT_LT(off, 1e-9) << t;
      EXPECT_NEAR(change.x(), 0.02, 4e-4) << t;
    }
  }
}

/// A hand that swings and turns, with noise of the tracker.
class Hand {
 public:
  Hand(double interval, double noise, double speed = 1.0) : interval_(interval), noise_(noise), speed_(speed) {}
  void set_noise(double noise) { noise_ = noise; }
  void restart() { predictor_.restart(); }
  /// Moves on by `seconds`. Returns the rms error of the prediction `ahead` [s] beyond each sample [m].
  double error(double seconds, double ahead) {
    double sum = 0.0;
    const int count = static_cast<int>(std::lround(seconds / interval_));
    for (int k = 0; k < count; ++k) {
      t_ += interval_;
      PoseSample sample = moved(t_);
      for (int i = 0; i < 3; ++i) sample.X.translation()[i] += noise_ * normal_(random_);
      predictor_.push(sample);
      const auto predicted = predictor_.predict(t_ + ahead);
      if (predicted) sum += (predicted->X.translation() - moved(t_ + ahead).X.translation()).squaredNorm();
    }
    return std::sqrt(sum / count);
  }

 private:
  PoseSample moved(double t) const {
    const double s = speed_ * t;
    return at(t, Vector3d(0.1 * std::sin(6.0 * s), 0.05 * std::sin(9.0 * s), 0.02 * std::sin(17.0 * s)),
              0.5 * std::sin(5.0 * s));
  }

  double interval_, noise_, speed_, t_ = 0.0;
  std::mt19937 random_{7};
  std::normal_distribution<double> normal_;
  PosePredictor predictor_;
};

/// The prediction of a swinging hand errs by little more than the noise, however large that is, and that of a resting
/// hand by less: its mean pose is the best prediction. Without a prediction the swinging hand would err by 17 mm.
TEST(PosePredictor, IsGoodWithAndWithoutNoise) {
  for (const auto& [noise, largest] : {std::pair(0.0, 3e-4), {1e-4, 9e-4}, {1e-3, 4e-3}, {5e-3, 1e-2}}) {
    Hand swings(1.0 / 120.0, noise), rests(1.0 / 120.0, noise, 0.0);
    swings.error(3.0, 0.02);
    rests.error(3.0, 0.02);
    EXPECT_LT(swings.error(5.0, 0.02), largest) << noise;
    EXPECT_LE(rests.error(5.0, 0.02), noise);
  }
}

/// Samples that are much rarer than the forgetting times still determine parabolas, from the third one on: as long as
/// no error is known, all models have the same weight, a fifth, which leaves four fifths of the parabola; afterwards,
/// only the parabolas count.
TEST(PosePredictor, FollowsASlowStream) {
  const auto slow = [](double t) { return PoseSample{t, on_parabola(0.05 * t).X}; };
  PosePredictor predictor;
  for (int k = 0; k < 20; ++k) {
    const double t = 0.45 * k;
    predictor.push(slow(t));
    if (k < 2) continue;
    const Vector3d moved = slow(t + 0.05).X.translation() - slow(t).X.translation();
    const Vector3d predicted = predictor.predict(t + 0.05)->X.translation() - slow(t).X.translation();
    EXPECT_LT((predicted - (k < 3 ? 0.8 : 1.0) * moved).norm(), 1e-6) << t;
  }
}

/// Of samples 2 ms apart every third is fitted, so the prediction from such a one is not moved by the other two, which
/// are off to the side.
TEST(PosePredictor, FitsSkipSamplesOfAFastStream) {
  PosePredictor predictor;
  for (int k = 0; k <= 600; ++k) {
    const double t = 0.002 * k;
    predictor.push(at(t, Vector3d(t, k % 3 == 0 ? 0.0 : 0.01, 0.0), 0.0));
    if (k < 3 || k % 3 != 0) continue;
    EXPECT_LT(std::abs(predictor.predict(t + 0.02)->X.translation().y()), 1e-12) << t;
  }
}

/// While the tracker shakes, long parabolas are best; afterwards, short ones.
TEST(PosePredictor, IsGoodAgainSoonAfterAShake) {
  Hand hand(1.0 / 120.0, 1e-4);
  hand.error(3.0, 0.02);
  const double usual = hand.error(3.0, 0.02);
  hand.set_noise(0.01);
  hand.error(3.0, 0.02);
  hand.set_noise(1e-4);
  hand.error(6.0, 0.02);
  EXPECT_LT(hand.error(3.0, 0.02), 1.5 * usual);
}

/// While few errors are known, too, the prediction errs by a tenth of what the hand moves.
TEST(PosePredictor, IsGoodSoonAfterARestart) {
  Hand hand(1.0 / 120.0, 1e-4);
  double sum = 0.0;
  constexpr int trials = 200;
  for (int trial = 0; trial < trials; ++trial) {
    hand.restart();
    hand.error(0.05, 0.02);
    const double error = hand.error(0.1, 0.02);
    sum += error * error;
  }
  EXPECT_LT(std::sqrt(sum / trials), 1.7e-3);
}

TEST(PosePredictor, RestsBeyondItsReachAndWhereNothingIsKnown) {
  PosePredictor predictor;
  EXPECT_FALSE(predictor.predict(1.0));
  const Vector3d p(0.1, 0.2, 0.3);
  predictor.push(at(0.0, p, 0.1));
  EXPECT_FALSE(predictor.predict(0.05));
  EXPECT_TRUE(predictor.continuation(0.05).empty());
  predictor.push(at(0.03, p, 0.1));
  EXPECT_FALSE(predictor.predict(0.03));
  for (int k = 2; k < 100; ++k) predictor.push(at(0.03 * k, p, 0.1));
  EXPECT_LT((predictor.predict(2.99)->X.matrix() - at(0.0, p, 0.1).X.matrix()).norm(), 1e-15);
  EXPECT_DOUBLE_EQ(predictor.predict(10.0)->t, 2.97 + PosePredictor::farthest);
  predictor.restart();
  EXPECT_FALSE(predictor.predict(1.0));
}

}  // namespace
}  // namespace spring_workbench::motion::pose_predictor_test
