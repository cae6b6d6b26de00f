#include "spring_workbench/hand_input/sample_gate.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "spring_workbench/hand_input/input_filter.h"
#include "spring_workbench/math/so3.h"

namespace spring_workbench::hand_input {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInf = std::numeric_limits<double>::infinity();
constexpr double kDropout = 0.5;
constexpr double kInterval = 1.0 / 120.0;

/// A quick hand: at most 2 m/s and 7 rad/s.
RawSample hand(double t) {
  RawSample sample;
  sample.t = t;
  sample.p = Vector3d(0.4 * std::sin(3.0 * t), 0.3 * std::cos(4.0 * t), 0.5 + 0.2 * std::sin(2.0 * t));
  sample.q = Quaterniond(math::exp_so3(Vector3d(1.5 * std::sin(3.0 * t), std::cos(2.0 * t), 3.0 * std::sin(t))));
  return sample;
}

TEST(SampleGate, EverySampleOfAHandIsAccepted) {
  SampleGate gate(TruthSettings(), kDropout);
  for (int k = 0; k < 5000; ++k) {
    EXPECT_EQ(gate.offer(hand(k * kInterval)), k == 0 ? Verdict::new_place : Verdict::accepted) << k;
  }
  EXPECT_EQ(gate.counts().accepted, 5000u);
  EXPECT_TRUE(gate.counts().left_out.empty());
}

TEST(SampleGate, NothingThatIsNotAPoseGetsThrough) {
  SampleGate gate(TruthSettings(), kDropout);
  gate.offer(hand(0.0));
  int k = 1;
  const auto verdict = [&](auto&& change) {
    RawSample sample = hand(kInterval * k++);
    change(sample);
    return gate.offer(sample);
  };
  for (const double bad : {kNan, kInf, -kInf}) {
    EXPECT_EQ(verdict([&](RawSample& s) { s.t = bad; }), Verdict::not_finite);
    for (int i = 0; i < 3; ++i) EXPECT_EQ(verdict([&](RawSample& s) { s.p[i] = bad; }), Verdict::not_finite);
    for (int i = 0; i < 4; ++i) EXPECT_EQ(verdict([&](RawSample& s) { s.q.coeffs()[i] = bad; }), Verdict::not_finite);
  }
  EXPECT_EQ(verdict([](RawSample& s) { s.q.coeffs().setZero(); }), Verdict::bad_quaternion);
  EXPECT_EQ(verdict([](RawSample& s) { s.q.coeffs() *= 1.11; }), Verdict::bad_quaternion);
  EXPECT_EQ(verdict([](RawSample& s) { s.q.coeffs() *= 0.89; }), Verdict::bad_quaternion);
  EXPECT_EQ(verdict([](RawSample& s) { s.p.x() = 1001.0; }), Verdict::too_far);
  EXPECT_EQ(verdict([](RawSample& s) { s.q.coeffs() *= 1.09; }), Verdict::accepted);
  const GateCounts& counts = gate.counts();
  EXPECT_EQ(counts.left_out.at(Verdict::not_finite), 24u);
  EXPECT_EQ(counts.left_out.at(Verdict::bad_quaternion), 3u);
  EXPECT_EQ(counts.left_out.at(Verdict::too_far), 1u);
}

TEST(SampleGate, AStampThatIsNotLaterIsLeftOut) {
  SampleGate gate(TruthSettings(), kDropout);
  for (int k = 0; k < 100; ++k) {
    EXPECT_TRUE(usable(gate.offer(hand(kInterval * k))));
    EXPECT_EQ(gate.offer(hand(kInterval * k)), Verdict::not_later);
    EXPECT_EQ(gate.offer(hand(kInterval * (k - 5))), Verdict::not_later);
  }
  EXPECT_EQ(gate.counts().accepted, 100u);
}

TEST(SampleGate, TheSignOfAQuaternionMeansNothing) {
  SampleGate gate(TruthSettings(), kDropout);
  std::mt19937 random(3);
  for (int k = 0; k < 1000; ++k) {
    RawSample sample = hand(kInterval * k);
    if (random() % 2 == 0) sample.q.coeffs() *= -1.0;
    EXPECT_TRUE(usable(gate.offer(sample)));
  }
  EXPECT_GT(gate.counts().sign_flips, 300u);
}

TEST(SampleGate, LoneOutliersNeverGetThrough) {
  std::mt19937 random(4);
  std::uniform_real_distribution<double> far(0.3, 2.0), angle(1.0, 3.0);
  SampleGate gate(TruthSettings(), kDropout);
  int outliers = 0;
  for (int k = 0; k < 5000; ++k) {
    RawSample sample = hand(kInterval * k);
    const bool moved = k % 7 == 3, turned = k % 11 == 5;
    if (moved) sample.p.y() += far(random);
    if (turned) sample.q = sample.q * Quaterniond(math::exp_so3(Vector3d(angle(random), 0, 0)));
    outliers += moved || turned ? 1 : 0;
    EXPECT_EQ(usable(gate.offer(sample)), !(moved || turned)) << k;
  }
  EXPECT_EQ(gate.counts().accepted, static_cast<std::size_t>(5000 - outliers));
  EXPECT_EQ(gate.counts().new_places, 0u);
}

TEST(SampleGate, ANewSteadyPlaceIsTrueAfterSoManySamples) {
  for (const int n : {1, 2, 5, 20}) {
    TruthSettings settings;
    settings.accept_after = n;
    SampleGate gate(settings, kDropout);
    for (int k = 0; k < 50; ++k) gate.offer(hand(kInterval * k));
    for (int k = 50; k < 200; ++k) {
      RawSample sample = hand(kInterval * k);
      sample.p.x() += 3.0;  // the hand is elsewhere from now on
      const Verdict verdict = gate.offer(sample);
      const int in_a_row = k - 49;
      EXPECT_EQ(verdict, in_a_row < n ? Verdict::too_fast : in_a_row == n ? Verdict::new_place : Verdict::accepted);
    }
    EXPECT_EQ(gate.counts().new_places, 1u);
  }
}

TEST(SampleGate, APlaceThatComesIntoReachOnlyWithTimeIsANewOne) {
  TruthSettings settings;
  settings.accept_after = 1000;
  SampleGate gate(settings, kDropout);
  for (int k = 0; k < 50; ++k) gate.offer(hand(kInterval * k));
  int k = 50;
  Verdict verdict = Verdict::too_fast;
  for (; verdict == Verdict::too_fast; ++k) {
    RawSample sample = hand(kInterval * k);
    sample.p.x() += 1.5;
    verdict = gate.offer(sample);
  }
  EXPECT_EQ(verdict, Verdict::new_place);
  EXPECT_NEAR(k - 50, 1.5 / (settings.max_speed * kInterval), 6.0);
}

TEST(SampleGate, ALongGapDoesNotLetEverythingThrough) {
  SampleGate gate(TruthSettings(), kDropout);
  gate.offer(hand(0.0));
  RawSample back = hand(60.0);
  back.p.x() += 8.0;  // beyond max_speed times dropout_after
  EXPECT_EQ(gate.offer(back), Verdict::too_fast);
  EXPECT_EQ(gate.offer(hand(60.0 + kInterval)), Verdict::new_place);
  EXPECT_EQ(gate.counts().dropouts, 1u);
}

TEST(SampleGate, AJumpToTheOriginIsOutOfViewHoweverLongItLasts) {
  SampleGate gate(TruthSettings(), kDropout);
  for (int k = 0; k < 1000; ++k) {
    RawSample sample = hand(kInterval * k);
    const bool out = k >= 100 && k < 900;
    if (out) {  // within noise of the identity
      sample.p = Vector3d(1e-4, -2e-4, 3e-4);
      sample.q = Quaterniond(math::exp_so3(Vector3d(1e-3, 0, 0)));
    }
    const Verdict verdict = gate.offer(sample);
    if (out) {
      EXPECT_EQ(verdict, Verdict::out_of_view);
    } else if (k < 100) {
      EXPECT_TRUE(usable(verdict));
    } else if (k > 905) {
      EXPECT_EQ(verdict, Verdict::accepted);
    }
  }
  EXPECT_EQ(gate.counts().left_out.at(Verdict::out_of_view), 800u);
}

TEST(SampleGate, AStreamThatBeginsAtTheOriginIsTrue) {
  SampleGate gate(TruthSettings(), kDropout);
  for (int k = 0; k < 100; ++k) {
    RawSample sample;
    sample.t = 0.1 * k;
    sample.p.x() = 1e-4 * k;
    EXPECT_TRUE(usable(gate.offer(sample)));
  }
}

TEST(SampleGate, ComplaintsNameFieldValueAndRuleInOneLine) {
  const TruthSettings settings;
  const RawSample bad{1.5, Vector3d(7.25, 0, 0), Quaterniond(0.5, 0, 0, 0)};
  for (const auto& [verdict, field, value] :
       std::vector<std::tuple<Verdict, std::string, std::string>>{{Verdict::bad_quaternion, "rotation", "0.5"},
                                                                  {Verdict::too_far, "position", "7.25"},
                                                                  {Verdict::not_later, "stamp", "1.5"},
                                                                  {Verdict::too_fast, "position", "7.25"},
                                                                  {Verdict::turns_too_fast, "rotation", "0.5"},
                                                                  {Verdict::out_of_view, "position", "7.25"}}) {
    const std::string line = complaint(verdict, bad, settings);
    for (const std::string& word : {field, value, std::string("must be")})
      EXPECT_NE(line.find(word), line.npos) << line;
    EXPECT_EQ(line.find('\n'), line.npos);
  }
  const RawSample nan{1.5, Vector3d(kNan, 0, 0), Quaterniond::Identity()};
  EXPECT_NE(complaint(Verdict::not_finite, nan, settings).find("position"), std::string::npos);
}

TEST(TruthLayer, APoseComesThroughToTheBit) {
  TruthLayer layer(TruthSettings(), kDropout);
  for (int k = 0; k < 200; ++k) {
    const RawSample raw = hand(kInterval * k);
    const motion::PoseSample sample{raw.t, make_transform(raw.q, raw.p)};
    const TrueSample taken = layer.take(sample);
    ASSERT_TRUE(usable(taken.verdict));
    EXPECT_EQ(taken.sample.t, sample.t);
    EXPECT_EQ(taken.sample.X.matrix(), sample.X.matrix());
  }
}

TEST(TruthLayer, AnyRubbishInGivesFiniteRotationsOut) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> number(-2.0, 2.0);
  const double odd[] = {kNan, kInf, -kInf, 0.0, 1e300, -1e300, 1e-300};
  const auto any = [&] { return random() % 10 == 0 ? odd[random() % 7] : number(random); };
  TruthSettings settings;
  settings.min_cutoff = 1.0;
  settings.prediction = 0.05;
  settings.max_speed = kInf;
  TruthLayer layer(settings, kDropout);
  std::size_t used = 0;
  double t = 0.0;
  for (int k = 0; k < 20000; ++k) {
    RawSample raw;
    raw.t = random() % 5 == 0 ? odd[random() % 3] : (t += random() % 10 == 0 ? 0.0 : 0.01);
    raw.p = Vector3d(any(), any(), any());
    raw.q = Quaterniond(any(), any(), any(), any());
    if (random() % 2 == 0) raw.q.normalize();
    const TrueSample taken = layer.take(raw);
    if (!usable(taken.verdict)) continue;
    ++used;
    ASSERT_TRUE(taken.sample.X.matrix().allFinite());
    const Matrix3d R = taken.sample.X.linear();
    ASSERT_LT((R.transpose() * R - Matrix3d::Identity()).norm(), 1e-12);
  }
  EXPECT_GT(used, 100u);
}

}  // namespace
}  // namespace spring_workbench::hand_input
