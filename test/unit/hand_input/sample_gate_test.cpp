#include "spring_workbench/hand_input/sample_gate.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "spring_workbench/hand_input/pose_filter.h"
#include "spring_workbench/math/so3.h"

namespace spring_workbench::hand_input::sample_gate_test {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInf = std::numeric_limits<double>::infinity();
constexpr double kDropout = 0.5;
constexpr double kInterval = 1.0 / 120.0;

/// A fast hand: at most 2 m/s and 7 rad/s.
RawSample hand(double t) {
  RawSample sample;
  sample.t = t;
  sample.p = Vector3d(0.4 * std::sin(3.0 * t), 0.3 * std::cos(4.0 * t), 0.5 + 0.2 * std::sin(2.0 * t));
  sample.q = Quaterniond(math::exp_so3(Vector3d(1.5 * std::sin(3.0 * t), std::cos(2.0 * t), 3.0 * std::sin(t))));
  return sample;
}

TEST(SampleGate, EverySampleOfAHandIsAccepted) {
  SampleGate gate(InputSettings(), kDropout);
  for (int k = 0; k < 5000; ++k) {
    EXPECT_EQ(gate.offer(hand(k * kInterval)), k == 0 ? GateResult::relocation : GateResult::accepted) << k;
  }
  EXPECT_EQ(gate.counts().accepted, 5000u);
  EXPECT_TRUE(gate.counts().rejected.empty());
}

TEST(SampleGate, NothingThatIsNotAPoseGetsThrough) {
  SampleGate gate(InputSettings(), kDropout);
  gate.offer(hand(0.0));
  int k = 1;
  const auto result = [&](auto&& change) {
    RawSample sample = hand(kInterval * k++);
    change(sample);
    return gate.offer(sample);
  };
  for (const double bad : {kNan, kInf, -kInf}) {
    EXPECT_EQ(result([&](RawSample& s) { s.t = bad; }), GateResult::not_finite);
    for (int i = 0; i < 3; ++i) EXPECT_EQ(result([&](RawSample& s) { s.p[i] = bad; }), GateResult::not_finite);
    for (int i = 0; i < 4; ++i) EXPECT_EQ(result([&](RawSample& s) { s.q.coeffs()[i] = bad; }), GateResult::not_finite);
  }
  EXPECT_EQ(result([](RawSample& s) { s.q.coeffs().setZero(); }), GateResult::bad_quaternion);
  EXPECT_EQ(result([](RawSample& s) { s.q.coeffs() *= 1.11; }), GateResult::bad_quaternion);
  EXPECT_EQ(result([](RawSample& s) { s.q.coeffs() *= 0.89; }), GateResult::bad_quaternion);
  EXPECT_EQ(result([](RawSample& s) { s.p.x() = 1001.0; }), GateResult::too_far);
  EXPECT_EQ(result([](RawSample& s) { s.q.coeffs() *= 1.09; }), GateResult::accepted);
  const GateCounts& counts = gate.counts();
  EXPECT_EQ(counts.rejected.at(GateResult::not_finite), 24u);
  EXPECT_EQ(counts.rejected.at(GateResult::bad_quaternion), 3u);
  EXPECT_EQ(counts.rejected.at(GateResult::too_far), 1u);
}

TEST(SampleGate, AStampThatIsNotLaterIsRejected) {
  SampleGate gate(InputSettings(), kDropout);
  for (int k = 0; k < 100; ++k) {
    EXPECT_TRUE(usable(gate.offer(hand(kInterval * k))));
    EXPECT_EQ(gate.offer(hand(kInterval * k)), GateResult::not_later);
    EXPECT_EQ(gate.offer(hand(kInterval * (k - 5))), GateResult::not_later);
  }
  EXPECT_EQ(gate.counts().accepted, 100u);
}

TEST(SampleGate, TheSignOfAQuaternionMeansNothing) {
  SampleGate gate(InputSettings(), kDropout);
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
  SampleGate gate(InputSettings(), kDropout);
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
  EXPECT_EQ(gate.counts().relocations, 0u);
}

TEST(SampleGate, ANewSteadyPlaceIsTrueAfterSoManySamples) {
  for (const int n : {1, 2, 5, 20}) {
    InputSettings settings;
    settings.accept_after = n;
    SampleGate gate(settings, kDropout);
    for (int k = 0; k < 50; ++k) gate.offer(hand(kInterval * k));
    for (int k = 50; k < 200; ++k) {
      RawSample sample = hand(kInterval * k);
      sample.p.x() += 3.0;  // the hand is elsewhere from now on
      const GateResult result = gate.offer(sample);
      const int in_a_row = k - 49;
      EXPECT_EQ(result, in_a_row < n    ? GateResult::too_fast
                        : in_a_row == n ? GateResult::relocation
                                        : GateResult::accepted);
    }
    EXPECT_EQ(gate.counts().relocations, 1u);
  }
}

TEST(SampleGate, APlaceThatComesIntoReachOnlyWithTimeIsANewOne) {
  InputSettings settings;
  settings.accept_after = 1000;
  SampleGate gate(settings, kDropout);
  for (int k = 0; k < 50; ++k) gate.offer(hand(kInterval * k));
  int k = 50;
  GateResult result = GateResult::too_fast;
  for (; result == GateResult::too_fast; ++k) {
    RawSample sample = hand(kInterval * k);
    sample.p.x() += 1.5;
    result = gate.offer(sample);
  }
  EXPECT_EQ(result, GateResult::relocation);
  EXPECT_NEAR(k - 50, 1.5 / (settings.max_speed * kInterval), 6.0);
}

TEST(SampleGate, ALongGapDoesNotLetEverythingThrough) {
  SampleGate gate(InputSettings(), kDropout);
  gate.offer(hand(0.0));
  RawSample back = hand(60.0);
  back.p.x() += 8.0;  // beyond max_speed times dropout_after
  EXPECT_EQ(gate.offer(back), GateResult::too_fast);
  EXPECT_EQ(gate.offer(hand(60.0 + kInterval)), GateResult::relocation);
  EXPECT_EQ(gate.counts().dropouts, 1u);
}

TEST(SampleGate, AJumpToTheOriginIsOutOfViewHoweverLongItLasts) {
  SampleGate gate(InputSettings(), kDropout);
  for (int k = 0; k < 1000; ++k) {
    RawSample sample = hand(kInterval * k);
    const bool out = k >= 100 && k < 900;
    if (out) {  // within noise of the identity
      sample.p = Vector3d(1e-4, -2e-4, 3e-4);
      sample.q = Quaterniond(math::exp_so3(Vector3d(1e-3, 0, 0)));
    }
    const GateResult result = gate.offer(sample);
    if (out) {
      EXPECT_EQ(result, GateResult::out_of_view);
    } else if (k < 100) {
      EXPECT_TRUE(usable(result));
    } else if (k > 905) {
      EXPECT_EQ(result, GateResult::accepted);
    }
  }
  EXPECT_EQ(gate.counts().rejected.at(GateResult::out_of_view), 800u);
}

TEST(SampleGate, AStreamThatBeginsAtTheOriginIsTrue) {
  SampleGate gate(InputSettings(), kDropout);
  for (int k = 0; k < 100; ++k) {
    RawSample sample;
    sample.t = 0.1 * k;
    sample.p.x() = 1e-4 * k;
    EXPECT_TRUE(usable(gate.offer(sample)));
  }
}

/// Samples close to the previous one in position, rotation or time, on both sides of the limits.
TEST(SampleGate, AcceptsWhatAHandCanAlwaysDo) {
  InputSettings settings;
  settings.max_speed = settings.max_turn_rate = 1e-3;
  const auto after = [&](double dt, double way, double turn) {
    SampleGate gate(settings, kDropout);
    gate.offer({1.0, Vector3d(0.5, 0, 0), Quaterniond::Identity()});
    return gate.offer({1.0 + dt, Vector3d(0.5 + way, 0, 0), Quaterniond(math::exp_so3(Vector3d(turn, 0, 0)))});
  };
  EXPECT_EQ(after(1e-3, 4.9e-3, 0.0), GateResult::accepted);
  EXPECT_EQ(after(1e-3, 5.1e-3, 0.0), GateResult::too_fast);
  EXPECT_EQ(after(1e-3, 0.0, 0.049), GateResult::accepted);
  EXPECT_EQ(after(1e-3, 0.0, 0.051), GateResult::turns_too_fast);
  EXPECT_EQ(after(5.1e-5, 0.0, 0.0), GateResult::accepted);
  EXPECT_EQ(after(4.9e-5, 0.0, 0.0), GateResult::stamp_too_close);
  EXPECT_EQ(after(0.6e-9, 0.0, 0.0), GateResult::stamp_too_close);
  EXPECT_EQ(after(0.4e-9, 0.0, 0.0), GateResult::not_later);
  for (const double share : {0.24, 0.26}) {  // of the usual interval
    SampleGate gate(settings, kDropout);
    for (int k = 0; k <= 100; ++k) gate.offer({0.01 * k, Vector3d(0.5, 0, 0), Quaterniond::Identity()});
    const GateResult result = gate.offer({1.0 + 0.01 * share, Vector3d(0.5, 0, 0), Quaterniond::Identity()});
    EXPECT_EQ(result, share > 0.25 ? GateResult::accepted : GateResult::stamp_too_close);
  }
  for (const double radii : {9.0, 11.0}) {  // a jump to the origin
    SampleGate gate(InputSettings(), kDropout);
    gate.offer({1.0, Vector3d(radii * InputSettings().origin_radius, 0, 0), Quaterniond::Identity()});
    const GateResult result = gate.offer({1.01, Vector3d::Zero(), Quaterniond::Identity()});
    EXPECT_EQ(result, radii > 10.0 ? GateResult::out_of_view : GateResult::accepted);
  }
}

/// After one step at speed v the low-passed speed is a v, a the weight of 8 Hz, and the cut-off is min_cutoff + beta a
/// v.
TEST(PoseFilter, OpensWithTheLowPassedSpeed) {
  const double dt = 0.01, v = 0.3;
  const auto weight = [&](double cutoff) { return 1.0 - 1.0 / (1.0 + 2.0 * M_PI * cutoff * dt); };
  InputSettings settings;
  settings.min_cutoff = 1.0;
  settings.beta = 20.0;
  PoseFilter filter(settings);
  filter.filter({0.0, RigidTransform::Identity()});
  const motion::PoseSample step{dt, make_transform(Vector3d(v * dt, 0, 0), Quaterniond::Identity())};
  const double share = filter.filter(step).X.translation().x() / (v * dt);
  EXPECT_NEAR(share, weight(1.0 + 20.0 * weight(8.0) * v), 1e-12);
}

/// The reason first, as /diagnostics counts it, then field and value, then the rule by the name of its setting.
TEST(SampleGate, ComplaintsNameReasonFieldValueAndSettingInOneLine) {
  const InputSettings settings;
  const RawSample bad{1.5, Vector3d(7.25, 0, 0), Quaterniond(0.5, 0, 0, 0)};
  const std::string position = "position (7.25, 0, 0) m ", rotation = "rotation (0, 0, 0, 0.5) ";
  for (const auto& [result, given, rule] : std::vector<std::tuple<GateResult, std::string, std::string>>{
           {GateResult::bad_quaternion, rotation, "input.quaternion_tolerance = 0.1"},
           {GateResult::too_far, position, "input.max_distance = 1000 m"},
           {GateResult::not_later, "stamp 1.5 s ", "the last sample"},
           {GateResult::stamp_too_close, "stamp 1.5 s ", "the last sample"},
           {GateResult::too_fast, position, "input.max_speed = 10 m/s"},
           {GateResult::turns_too_fast, rotation, "input.max_turn_rate = 50 rad/s"},
           {GateResult::out_of_view, position, "input.origin_radius = 0.001 m"},
           {GateResult::out_of_view, position, "input.origin_angle = 0.02 rad"}}) {
    const std::string line = complaint(result, bad, settings);
    EXPECT_EQ(line.rfind(to_string(result) + ": " + given, 0), 0u) << line;
    EXPECT_NE(line.find(rule), line.npos) << line;
    EXPECT_EQ(line.find('\n'), line.npos);
  }
  const RawSample nan{1.5, Vector3d(kNan, 0, 0), Quaterniond::Identity()};
  EXPECT_NE(complaint(GateResult::not_finite, nan, settings).find("position"), std::string::npos);
}

TEST(SampleGate, AnyRubbishGivesFiniteRotationsBehindGateAndSmoothing) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> number(-2.0, 2.0);
  const double odd[] = {kNan, kInf, -kInf, 0.0, 1e300, -1e300, 1e-300};
  const auto any = [&] { return random() % 10 == 0 ? odd[random() % 7] : number(random); };
  InputSettings settings;
  settings.min_cutoff = 1.0;
  settings.max_speed = kInf;
  SampleGate gate(settings, kDropout);
  PoseFilter smoothing(settings);
  std::size_t used = 0;
  double t = 0.0;
  for (int k = 0; k < 20000; ++k) {
    RawSample raw;
    raw.t = random() % 5 == 0 ? odd[random() % 3] : (t += random() % 10 == 0 ? 0.0 : 0.01);
    raw.p = Vector3d(any(), any(), any());
    raw.q = Quaterniond(any(), any(), any(), any());
    if (random() % 2 == 0) raw.q.normalize();
    const GateResult result = gate.offer(raw);
    if (!usable(result)) continue;
    ++used;
    if (result == GateResult::relocation) smoothing.restart();
    const RigidTransform X = smoothing.filter({raw.t, make_transform(raw.p, raw.q)}).X;
    ASSERT_TRUE(X.matrix().allFinite());
    const Matrix3d R = X.linear();
    ASSERT_LT((R.transpose() * R - Matrix3d::Identity()).norm(), 1e-12);
  }
  EXPECT_GT(used, 100u);
}

}  // namespace
}  // namespace spring_workbench::hand_input::sample_gate_test
