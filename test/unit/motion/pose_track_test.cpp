#include "spring_workbench/motion/pose_track.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include "spring_workbench/math/so3.h"
#include "spring_workbench/validation/input_error.h"

namespace spring_workbench::motion::pose_track_test {
namespace {

constexpr double kNever = std::numeric_limits<double>::infinity();

class Random {
 public:
  explicit Random(unsigned seed) : engine_(seed) {}
  double number(double min, double max) { return std::uniform_real_distribution<double>(min, max)(engine_); }
  Vector3d vector(double size) { return {number(-size, size), number(-size, size), number(-size, size)}; }
  RigidTransform pose() {
    return make_transform(vector(1.0), Quaterniond(number(-1, 1), number(-1, 1), number(-1, 1), number(1, 2)));
  }

 private:
  std::mt19937 engine_;
};

/// A hand that wanders: uneven stamps, up to a radian between samples.
std::vector<PoseSample> wandering_hand(unsigned seed, int count) {
  Random random(seed);
  std::vector<PoseSample> samples;
  PoseSample sample;
  sample.X = random.pose();
  for (int i = 0; i < count; ++i) {
    samples.push_back(sample);
    sample.t += random.number(0.005, 0.04);
    sample.X.translation() += random.vector(0.02);
    sample.X.linear() = sample.X.linear() * math::exp_so3(random.vector(0.6));
  }
  return samples;
}

PoseTrack track_of(const std::vector<PoseSample>& samples, double dropout_after = kNever) {
  PoseTrack track(dropout_after);
  for (const PoseSample& sample : samples) EXPECT_TRUE(track.push(sample));
  return track;
}

double distance(const RigidTransform& a, const RigidTransform& b) { return (a.matrix() - b.matrix()).norm(); }
double distance(const Twist& a, const Twist& b) {
  return (a.linear - b.linear).norm() + (a.angular - b.angular).norm();
}

void expect_c1(const MotionSegment& before, const MotionSegment& after) {
  ASSERT_EQ(before.end(), after.begin());
  const MotionState left = before.at(before.end());
  const MotionState right = after.at(after.begin());
  EXPECT_LT(distance(left.X, right.X), 1e-14);
  EXPECT_LT(distance(left.velocity, right.velocity), 1e-10 * (1.0 + right.velocity.angular.norm()));
}

TEST(PoseTrack, PassesThroughEverySample) {
  const auto samples = wandering_hand(1, 200);
  PoseTrack track = track_of(samples);
  for (std::size_t k = 0; k + 1 < samples.size(); ++k) {
    const MotionSegment segment = track.segment(samples[k].t);
    EXPECT_EQ(segment.begin(), samples[k].t);
    EXPECT_EQ(segment.end(), samples[k + 1].t);
    EXPECT_LT(distance(segment.at(samples[k].t).X, samples[k].X), 1e-14);
    EXPECT_LT(distance(segment.at(samples[k + 1].t).X, samples[k + 1].X), 1e-14);
  }
}

TEST(PoseTrack, VelocityHasNoJump) {
  const auto samples = wandering_hand(2, 200);
  PoseTrack track = track_of(samples);
  for (std::size_t k = 0; k + 2 < samples.size(); ++k) {
    const MotionSegment before = track.segment(samples[k].t);
    expect_c1(before, track.segment(samples[k + 1].t));
  }
}

TEST(PoseTrack, LiveVelocityHasNoJump) {
  const auto samples = wandering_hand(3, 200);
  PoseTrack track;
  track.push(samples[0]);
  track.push(samples[1]);
  MotionSegment before = track.segment(samples[0].t);
  for (std::size_t k = 1; k + 1 < samples.size(); ++k) {
    ASSERT_TRUE(track.push(samples[k + 1]));
    const MotionSegment after = track.segment(samples[k].t);
    expect_c1(before, after);
    track.forget_before(samples[k].t);
    before = after;
  }
}

TEST(PoseTrack, ForgettingChangesNothing) {
  const auto samples = wandering_hand(4, 100);
  PoseTrack whole = track_of(samples);
  PoseTrack forgetful = track_of(samples);
  for (std::size_t k = 0; k + 1 < samples.size(); ++k) {
    const double t = 0.3 * samples[k].t + 0.7 * samples[k + 1].t;
    forgetful.forget_before(t);
    EXPECT_LE(forgetful.begin(), samples[k].t);
    EXPECT_GE(forgetful.begin(), samples[k == 0 ? 0 : k - 1].t);
    const MotionState a = whole.segment(t).at(t);
    const MotionState b = forgetful.segment(t).at(t);
    EXPECT_EQ(a.X.matrix(), b.X.matrix());
    EXPECT_EQ(a.velocity.angular, b.velocity.angular);
    EXPECT_EQ(a.acceleration.angular, b.acceleration.angular);
  }
}

TEST(MotionSegment, VelocityAndAccelerationAreDerivativesToSecondOrder) {
  Random random(5);
  for (int trial = 0; trial < 100; ++trial) {
    PoseSample a, b;
    a.X = random.pose();
    b.X = random.pose();
    b.t = 1.0;
    const MotionSegment segment(a, random.vector(1.0), random.vector(2.0), b, random.vector(1.0), random.vector(2.0));
    const double t = random.number(0.1, 0.9);
    const MotionState state = segment.at(t);
    const auto error = [&](double h) {
      const MotionState left = segment.at(t - h);
      const MotionState right = segment.at(t + h);
      const Vector3d angle = math::log_so3(right.X.linear() * left.X.linear().transpose());
      return Vector3d(
          (angle / (2.0 * h) - state.velocity.angular).norm(),
          ((right.velocity.angular - left.velocity.angular) / (2.0 * h) - state.acceleration.angular).norm(),
          ((right.X.translation() - left.X.translation()) / (2.0 * h) - state.velocity.linear).norm() +
              ((right.velocity.linear - left.velocity.linear) / (2.0 * h) - state.acceleration.linear).norm());
    };
    const Vector3d coarse = error(2e-3);
    const Vector3d fine = error(1e-3);
    for (int i = 0; i < 3; ++i) {
      EXPECT_LT(fine[i], 0.26 * coarse[i] + 1e-9) << "derivative " << i;
      EXPECT_LT(fine[i], 1e-2);
    }
  }
}

/// Against differences of the fixed frame's own poses, and for packs against single moments.
TEST(MotionSegment, OfAnotherFrameIsTheMotionOfThatFrame) {
  Random random(8);
  for (int trial = 0; trial < 20; ++trial) {
    const PoseSample a{0.0, random.pose()};
    const PoseSample b{0.02, a.X * make_transform(random.vector(0.02), Quaterniond(math::exp_so3(random.vector(0.3))))};
    const MotionSegment of_B(a, random.vector(1.0), random.vector(5.0), b, random.vector(1.0), random.vector(5.0));
    const RigidTransform X_BC = random.pose(), X_CD = random.pose();
    const MotionSegment of_C = of_B.of_frame(X_BC);
    constexpr double t = 0.009, h = 2e-5;
    const RigidTransform X = of_B.at(t).X * X_BC;
    const RigidTransform before = of_B.at(t - h).X * X_BC, after = of_B.at(t + h).X * X_BC;
    const MotionState m = of_C.at(t);
    EXPECT_LT(distance(m.X, X), 1e-14);
    const Vector3d p = X.translation(), w = m.velocity.angular;
    EXPECT_LT(((after.translation() - before.translation()) / (2.0 * h) - m.velocity.linear).norm(), 1e-3);
    EXPECT_LT(((after.translation() - 2.0 * p + before.translation()) / (h * h) - m.acceleration.linear).norm(),
              1e-4 * (1.0 + m.acceleration.linear.norm()));
    EXPECT_LT((math::log_so3(after.linear() * before.linear().transpose()) / (2.0 * h) - w).norm(), 1e-3);
    const Vector3d change = of_C.at(t + h).velocity.angular - of_C.at(t - h).velocity.angular;
    EXPECT_LT((change / (2.0 * h) - m.acceleration.angular).norm(), 1e-4 * (1.0 + m.acceleration.angular.norm()));
    EXPECT_LT(distance(of_C.of_frame(X_CD).at(t).X, of_B.of_frame(X_BC * X_CD).at(t).X), 1e-14);

    const math::Pack times = {0.0, 0.004, t, 0.02};
    const BodyFrameRates<math::Pack> f = of_C.body_frame_rates(times, 9.81);
    for (int i = 0; i < math::pack_size; ++i) {
      const BodyRateState own = of_C.body_rate_state(times[i]);
      const Vector3d a_C = own.X.linear().transpose() * (own.a_W + 9.81 * Vector3d::UnitZ());
      EXPECT_LT((math::matrix(f.R_WB, i) - own.X.linear()).norm(), 1e-13);
      EXPECT_LT((vector(f.v_B, i) - own.X.linear().transpose() * own.v_W).norm(), 1e-12 * (1.0 + own.v_W.norm()));
      EXPECT_LT((vector(f.w_B, i) - own.w_B).norm(), 1e-12 * (1.0 + own.w_B.norm()));
      EXPECT_LT((vector(f.alpha_B, i) - own.alpha_B).norm(), 1e-12 * (1.0 + own.alpha_B.norm()));
      EXPECT_LT((vector(f.a_B, i) - a_C).norm(), 1e-12 * (1.0 + a_C.norm()));
    }
  }
}

TEST(MotionSegment, CubicMotionIsExact) {
  Random random(6);
  const Vector3d c0 = random.vector(1.0), c1 = random.vector(1.0), c2 = random.vector(1.0), c3 = random.vector(1.0);
  const auto p = [&](double t) -> Vector3d { return c0 + t * (c1 + t * (c2 + t * c3)); };
  const auto v = [&](double t) -> Vector3d { return c1 + t * (2.0 * c2 + t * 3.0 * c3); };
  PoseSample a, b;
  a.t = 0.4;
  b.t = 1.1;
  a.X.translation() = p(a.t);
  b.X.translation() = p(b.t);
  const MotionSegment segment(a, v(a.t), Vector3d::Zero(), b, v(b.t), Vector3d::Zero());
  for (double t = 0.4; t <= 1.1; t += 0.07) {
    const MotionState state = segment.at(t);
    EXPECT_LT((state.X.translation() - p(t)).norm(), 1e-14);
    EXPECT_LT((state.velocity.linear - v(t)).norm(), 1e-13);
    EXPECT_LT((state.acceleration.linear - (2.0 * c2 + 6.0 * t * c3)).norm(), 1e-12);
  }
}

/// The three-point rule is exact for parabolas and for a constant rate at uneven stamps; at the ends, the chord for the
/// latter.
TEST(PoseTrack, ParabolaAndConstantRateAreExact) {
  Random random(7);
  const Vector3d c0 = random.vector(1.0), c1 = random.vector(1.0), c2 = random.vector(3.0), w_B = random.vector(3.0);
  const Matrix3d R_0 = random.pose().linear();
  std::vector<PoseSample> samples;
  for (double t = 0.0; samples.size() < 50; t += random.number(0.005, 0.1)) {
    PoseSample sample;
    sample.t = t;
    sample.X.translation() = c0 + t * (c1 + t * c2);
    sample.X.linear() = R_0 * math::exp_so3(t * w_B);
    samples.push_back(sample);
  }
  PoseTrack track = track_of(samples);
  for (double t = 0.0; t < track.end(); t += 0.003) {
    const MotionState state = track.segment(t).at(t);
    if (t >= samples[1].t && t <= samples[48].t) {
      EXPECT_LT((state.X.translation() - (c0 + t * (c1 + t * c2))).norm(), 1e-13);
      EXPECT_LT((state.velocity.linear - (c1 + 2.0 * t * c2)).norm(), 1e-11);
    }
    EXPECT_LT((state.X.linear() - R_0 * math::exp_so3(t * w_B)).norm(), 1e-12);
    EXPECT_LT((state.velocity.angular - R_0 * w_B).norm(), 1e-10);
    EXPECT_LT(state.acceleration.angular.norm(), 1e-7);
  }
}

/// Smooth motion is met with order three away from the ends (the velocities at the samples have order two).
TEST(PoseTrack, SmoothMotionConvergesWithOrderThree) {
  const auto pose = [](double t) {
    RigidTransform X = RigidTransform::Identity();
    X.translation() = Vector3d(std::sin(t), std::cos(2.0 * t), std::sin(3.0 * t));
    X.linear() = math::exp_so3(Vector3d(std::sin(t), 0.0, 0.0)) * math::exp_so3(Vector3d(0.3 * t, std::cos(t), 0.0));
    return X;
  };
  const auto error = [&](int per_second) {
    PoseTrack track(kNever);
    for (int i = 0; i <= 3 * per_second; ++i) {
      PoseSample sample;
      sample.t = static_cast<double>(i) / per_second;
      sample.X = pose(sample.t);
      track.push(sample);
    }
    double worst = 0.0;
    for (double t = 0.2; t < 2.8; t += 1e-3) worst = std::max(worst, distance(track.segment(t).at(t).X, pose(t)));
    return worst;
  };
  const double coarse = error(25);
  EXPECT_LT(coarse, 1e-3);
  EXPECT_LT(error(50), coarse / 7.0);
}

TEST(PoseTrack, TurnsWithTheWorldAndMovesWithTime) {
  const auto samples = wandering_hand(8, 50);
  const RigidTransform X_VW = Random(9).pose();
  const double shift = 64.0;
  auto moved = samples;
  for (PoseSample& sample : moved) {
    sample.X = X_VW * sample.X;
    sample.t += shift;
  }
  PoseTrack track = track_of(samples);
  PoseTrack moved_track = track_of(moved);
  for (double t = 0.0; t < samples.back().t; t += 0.0037) {
    const MotionState a = track.segment(t).at(t);
    const MotionState b = moved_track.segment(t + shift).at(t + shift);
    const Matrix3d R_VW = X_VW.linear();
    EXPECT_LT(distance(X_VW * a.X, b.X), 1e-11);
    EXPECT_LT((R_VW * a.velocity.linear - b.velocity.linear).norm(), 1e-8);
    EXPECT_LT((R_VW * a.velocity.angular - b.velocity.angular).norm(), 1e-8);
    EXPECT_LT((R_VW * a.acceleration.linear - b.acceleration.linear).norm(), 1e-5);
    EXPECT_LT((R_VW * a.acceleration.angular - b.acceleration.angular).norm(), 1e-5);
  }
}

TEST(PoseTrack, TwoSamplesGiveTheChord) {
  Random random(10);
  PoseSample a, b;
  a.X = random.pose();
  b.X = random.pose();
  b.t = 0.5;
  PoseTrack track = track_of({a, b});
  const Vector3d v = (b.X.translation() - a.X.translation()) / 0.5;
  const Vector3d w = a.X.linear() * math::log_so3(a.X.linear().transpose() * b.X.linear()) / 0.5;
  for (double t = 0.0; t < 0.5; t += 0.05) {
    const MotionState state = track.segment(t).at(t);
    EXPECT_LT((state.velocity.linear - v).norm(), 1e-13);
    EXPECT_LT((state.velocity.angular - w).norm(), 1e-13);
  }
}

TEST(PoseTrack, RestsAfterTheNewestSample) {
  const auto samples = wandering_hand(11, 5);
  PoseTrack track = track_of(samples);
  for (const double later : {0.0, 1.0, 1e6}) {
    const double t = samples.back().t + later;
    const MotionState state = track.segment(t).at(t);
    EXPECT_EQ(state.X.matrix(), samples.back().X.matrix());
    EXPECT_EQ(state.velocity.linear, Vector3d::Zero());
    EXPECT_EQ(state.acceleration.angular, Vector3d::Zero());
  }
  PoseSample next = samples.back();
  next.t += 0.1;
  next.X.translation().x() += 1.0;
  ASSERT_TRUE(track.push(next));
  const double t = next.t - 0.05;
  EXPECT_GT(track.segment(t).at(t).velocity.linear.norm(), 1.0) << "the rest ends when the next sample is known";
}

TEST(PoseTrack, DropoutHoldsTheLastPose) {
  auto samples = wandering_hand(12, 20);
  for (std::size_t k = 10; k < samples.size(); ++k) samples[k].t += 1.0;
  PoseTrack track = track_of(samples, 0.5);
  const MotionSegment gap = track.segment(samples[9].t + 0.7);
  EXPECT_EQ(gap.begin(), samples[9].t);
  EXPECT_EQ(gap.end(), samples[10].t);
  const MotionState state = gap.at(samples[9].t + 0.7);
  EXPECT_EQ(state.X.matrix(), samples[9].X.matrix());
  EXPECT_EQ(state.velocity.linear, Vector3d::Zero());
  EXPECT_EQ(state.velocity.angular, Vector3d::Zero());
  EXPECT_LT(distance(track.segment(samples[10].t).at(samples[10].t).X, samples[10].X), 1e-15);

  // Neither side knows of the other: both are what they would be on their own.
  PoseTrack first = track_of({samples.begin(), samples.begin() + 10}, 0.5);
  PoseTrack second = track_of({samples.begin() + 10, samples.end()}, 0.5);
  for (double t = samples[0].t; t < samples[9].t; t += 0.004) {
    EXPECT_EQ(track.segment(t).at(t).X.matrix(), first.segment(t).at(t).X.matrix());
  }
  for (double t = samples[10].t; t < samples[19].t; t += 0.004) {
    EXPECT_EQ(track.segment(t).at(t).X.matrix(), second.segment(t).at(t).X.matrix());
  }
}

TEST(PoseTrack, EqualAndBackwardStampsAreIgnored) {
  const auto samples = wandering_hand(13, 10);
  PoseTrack clean = track_of(samples);
  PoseTrack track(kNever);
  Random random(14);
  for (const PoseSample& sample : samples) {
    EXPECT_TRUE(track.push(sample));
    for (const double back : {0.0, 1e-11, 0.003, 5.0}) {
      EXPECT_FALSE(track.push({sample.t - back, random.pose()}));
    }
    EXPECT_FALSE(track.push({sample.t + 1e-11, random.pose()}));
    EXPECT_EQ(track.end(), sample.t);
  }
  for (double t = 0.0; t < samples.back().t; t += 0.01) {
    EXPECT_EQ(track.segment(t).at(t).X.matrix(), clean.segment(t).at(t).X.matrix());
  }
}

TEST(PoseTrack, ItsLimitsAreAtTheDocumentedValues) {
  const RigidTransform here = RigidTransform::Identity();
  PoseTrack near(kNever);
  EXPECT_TRUE(near.push({0.0, here}));
  EXPECT_FALSE(near.push({0.45e-9, here}));
  EXPECT_TRUE(near.push({0.55e-9, here}));
  PoseTrack track(kNever);
  PoseSample sample{0.0, here};
  sample.X.translation().y() = 1.1e9;
  EXPECT_THROW(track.push(sample), validation::InputError);
  sample.X.translation().y() = 0.9e9;
  EXPECT_TRUE(track.push(sample));
  sample = {1.0, here};
  sample.X.linear()(0, 0) = 1.0 + 0.55e-6;  // RᵀR − I is twice as large
  EXPECT_THROW(track.push(sample), validation::InputError);
  sample.X.linear()(0, 0) = 1.0 + 0.45e-6;
  EXPECT_TRUE(track.push(sample));
  EXPECT_THROW(track.push({1.1e12, here}), validation::InputError);
  EXPECT_TRUE(track.push({0.9e12, here}));
}

TEST(PoseTrack, RefusesInvalidPosesAndIsUnchanged) {
  const auto samples = wandering_hand(15, 3);
  PoseTrack track = track_of(samples);
  const double t_next = samples.back().t + 0.1;
  const double bad_numbers[] = {std::nan(""), kNever, -kNever, 1e300};
  for (const double bad : bad_numbers) {
    EXPECT_THROW(track.push({bad, samples[0].X}), validation::InputError) << bad;
    for (int i = 0; i < 12; ++i) {
      PoseSample sample{t_next, samples[0].X};
      sample.X.matrix()(i % 3, i / 3) = bad;
      EXPECT_THROW(track.push(sample), validation::InputError) << bad << " at " << i;
    }
  }
  PoseSample mirrored{t_next, samples[0].X};
  mirrored.X.linear() = -mirrored.X.linear();
  EXPECT_THROW(track.push(mirrored), validation::InputError);
  PoseSample zero{t_next, samples[0].X};
  zero.X.linear().setZero();
  EXPECT_THROW(track.push(zero), validation::InputError);
  EXPECT_EQ(track.end(), samples.back().t);
  EXPECT_THROW(PoseTrack(std::nan("")), validation::InputError);
  EXPECT_THROW(PoseTrack(0.0), validation::InputError);
}

TEST(PoseTrack, AskingBeforeTheFirstSampleIsAnError) {
  PoseTrack track;
  EXPECT_TRUE(track.empty());
  EXPECT_THROW(track.segment(0.0), std::logic_error);
  track.push({1.0, RigidTransform::Identity()});
  EXPECT_THROW(track.segment(0.5), std::logic_error);
  EXPECT_THROW(track.segment(std::nan("")), std::logic_error);
  track.clear();
  EXPECT_TRUE(track.empty());
}

/// Anything that can be pushed gives finite motion: shortest intervals, largest positions, half turns.
TEST(PoseTrack, NothingThatIsTakenGivesNaN) {
  Random random(16);
  for (int trial = 0; trial < 2000; ++trial) {
    PoseTrack track(kNever);
    double t = random.number(-1.0, 1.0) * std::pow(10.0, random.number(0.0, 11.0));
    const double start = t;
    for (int k = 0; k < 5; ++k) {
      const double half_turn = random.number(0.0, 1.0) < 0.3 ? M_PI : random.number(-M_PI, M_PI);
      PoseSample sample;
      sample.t = t;
      sample.X.linear() = math::exp_so3(half_turn * random.vector(1.0).normalized());
      sample.X.translation() = random.vector(1.0) * std::pow(10.0, random.number(-12.0, 9.0));
      track.push(sample);
      t += std::pow(10.0, random.number(-9.0, 12.0));
      if (t > 1e12) break;
    }
    for (int i = 0; i <= 20; ++i) {
      const double at = start + i / 20.0 * (track.end() - start);
      const MotionState state = track.segment(at).at(at);
      ASSERT_TRUE(state.X.matrix().allFinite());
      EXPECT_TRUE(state.velocity.linear.allFinite() && state.velocity.angular.allFinite());
      EXPECT_TRUE(state.acceleration.linear.allFinite() && state.acceleration.angular.allFinite());
    }
  }
}

}  // namespace
}  // namespace spring_workbench::motion::pose_track_test
