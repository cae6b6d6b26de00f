#include "spring_workbench/fastrak/cadence_clock.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <iostream>
#include <random>

#include "spring_workbench/fastrak/station_stream.h"
#include "spring_workbench/hand_input/sample_gate.h"
#include "spring_workbench/motion/pose_track.h"

namespace spring_workbench::fastrak::cadence_clock_test {
namespace {

constexpr double kInterval = 1.0 / 120.0;

/// Standard deviation of x.
struct Spread {
  double sum = 0.0, squares = 0.0;
  int count = 0;
  void add(double x) {
    sum += x;
    squares += x * x;
    ++count;
  }
  double deviation() const { return std::sqrt(std::max(0.0, squares / count - sum * sum / count / count)); }
};

struct Line {
  double drift = 0.0;
  double mean_delay = 0.0;  ///< exponentially distributed [s]
  double poll = 0.0;        ///< receipts are at multiples of it, as behind a USB adapter [s]
};

/// Runs two minutes; returns the spread of receipts and of stamps about the device's own times, after the first ten
/// seconds.
std::pair<double, double> jitter(const Line& line, unsigned seed) {
  std::mt19937 random(seed);
  std::exponential_distribution<double> delay(1.0 / line.mean_delay);
  CadenceClock clock(kInterval);
  Spread before, after;
  double receipt = 0.0, last = -1.0;
  for (int k = 0; k < 120 * 120; ++k) {
    const double measured = 1000.0 + k * kInterval * (1.0 + line.drift);
    double came = measured + delay(random);
    if (line.poll > 0.0) came = std::ceil(came / line.poll) * line.poll;
    receipt = std::max(receipt, came);  // records stay in order
    const double stamp = clock.stamp(receipt);
    EXPECT_GT(stamp, last);
    EXPECT_LE(stamp, receipt + 1e-4);
    last = stamp;
    if (k < 1200) continue;
    before.add(receipt - measured);
    after.add(stamp - measured);
  }
  EXPECT_NEAR(clock.drift(), line.drift, line.poll > 0.0 ? 3e-4 : 1e-4);
  return {before.deviation(), after.deviation()};
}

TEST(CadenceClock, AnEvenStreamIsStampedAsItComes) {
  CadenceClock clock(kInterval);
  for (int k = 0; k < 5000; ++k) {
    const double t = 50.0 + k * kInterval;
    EXPECT_NEAR(clock.stamp(t), t, 1e-5);
  }
}

TEST(CadenceClock, JitterIsAtLeastTenTimesLessWhateverTheDrift) {
  unsigned seed = 1;
  for (const double drift : {-1e-3, -1e-4, 0.0, 1e-4, 1e-3}) {
    for (const double poll : {0.0, 0.016}) {
      const auto [before, after] = jitter({drift, 0.003, poll}, seed++);
      std::cout << "drift " << drift << ", poll " << poll << " s: jitter " << 1e3 * before << " ms -> " << 1e3 * after
                << " ms\n";
      EXPECT_GT(before, 0.002);
      EXPECT_LT(after, before / 10.0);
    }
  }
}

TEST(CadenceClock, AfterALostRecordAtALowRateSixteenReceiptsDecide) {
  constexpr double interval = 1.0 / 15.0;
  CadenceClock clock(interval);
  int early = 0;
  for (int k = 0; k < 300; ++k) {
    if (k == 100) continue;  // the silence is no longer than between other records
    const double t = k * interval;
    early += t - clock.stamp(t) > 0.5 * interval;
  }
  EXPECT_NEAR(early, 16, 2);
}

TEST(CadenceClock, DriftIsFollowedAfterTwoSeconds) {
  constexpr double drift = 2e-3;
  CadenceClock clock(kInterval);
  for (int k = 0; k * kInterval < 10.0; ++k) {
    const double t = k * kInterval * (1.0 + drift), late = t - clock.stamp(t);
    if (t < 1.9) {
      EXPECT_NEAR(late, drift * t, 1e-4) << t;
    } else if (t > 2.6) {
      EXPECT_LT(late, 1e-4) << t;
    }
  }
}

TEST(CadenceClock, RecoversFromLostRecordsAndStalls) {
  std::mt19937 random(9);
  std::exponential_distribution<double> delay(1.0 / 0.001);
  CadenceClock clock(kInterval);
  double receipt = 0.0;
  int wrong = 0, after_fault = 1000;
  for (int k = 0; k < 120 * 60; ++k) {
    const double measured = k * kInterval;
    receipt = std::max(receipt, measured + delay(random));
    const bool lost = k % 1000 >= 500 && k % 1000 < 507;
    if (k % 1000 == 800) receipt += 0.2;  // a stall: the records after it come in one burst
    if (lost || (k > 3000 && k < 3400)) {
      after_fault = 0;
      continue;
    }
    const double stamp = clock.stamp(receipt);
    ++after_fault;
    if (std::abs(stamp - measured) > 0.5 * kInterval) {
      ++wrong;
      EXPECT_LE(after_fault, 61) << k;
    }
  }
  EXPECT_LE(wrong, 8 * 61);
}

/// The measured rate is as good as a known one.
TEST(StationStream, StampsByTheCadenceThatItMeasures) {
  for (const double rate : {15.0, 50.0, 100.0, 120.0}) {
    for (const double poll : {0.0, 0.016}) {
      for (const unsigned seed : {1u, 2u, 3u}) {
        std::mt19937 random(seed);
        std::exponential_distribution<double> delay(1.0 / 0.003);
        StationStream stream(0.5, true);
        Spread before, after;
        double receipt = -1.0;
        for (int k = 0; k < static_cast<int>(60.0 * rate); ++k) {
          const double measured = k / rate;
          double came = measured + delay(random);
          if (poll > 0.0) came = std::ceil(came / poll) * poll;
          receipt = std::max(receipt + 1e-6, came);
          const double stamp = stream.stamp(receipt);
          if (measured < 10.0) continue;
          before.add(receipt - measured);
          after.add(stamp - measured);
        }
        std::cout << rate << " Hz, poll " << poll << " s: jitter " << 1e3 * before.deviation() << " ms -> "
                  << 1e3 * after.deviation() << " ms\n";
        EXPECT_LT(after.deviation(), before.deviation() / (poll > 0.0 ? 5.0 : 20.0));
      }
    }
  }
}

/// Records lost during the measurement of the rate make it wrong for some ten seconds, but not permanently.
TEST(StationStream, MeasuresAWrongRateAgain) {
  std::mt19937 random(8);
  std::exponential_distribution<double> delay(1.0 / 0.003);
  StationStream stream(0.5, true);
  Spread before, after;
  double receipt = -1.0;
  for (int k = 0; k < 120 * 60; ++k) {
    const double measured = k * kInterval;
    receipt = std::max(receipt + 1e-6, measured + delay(random));
    if (k > 100 && k < 300 && k % 20 < 3) continue;
    const double stamp = stream.stamp(receipt);
    if (measured < 30.0) continue;
    before.add(receipt - measured);
    after.add(stamp - measured);
  }
  EXPECT_EQ(after.count, 30 * 120);
  EXPECT_LT(after.deviation(), before.deviation() / 20.0);
}

/// A hand that moves along x at 1 m/s is read in bursts from the start: the interpolated motion must stay on its path.
/// Samples microseconds apart would give velocities of a thousand metres per second; the gate rejects them.
TEST(StationStream, BurstsMakeNoJumpBetweenSamples) {
  for (const double rate : {50.0, 120.0, 1000.0}) {
    std::mt19937 random(4);
    std::exponential_distribution<double> delay(1.0 / 0.5e-3), between_reads(1.0 / 4e-3);
    StationStream stream(0.5, true);
    hand_input::SampleGate gate(hand_input::InputSettings(), 0.5);
    motion::PoseTrack track(0.5);
    double read_at = 0.0, last = 0.0, farthest = 0.0;
    int used = 0, sent = 0;
    for (int k = 0; k < static_cast<int>(10.0 * rate); ++k) {
      const double measured = k / rate, due = measured + delay(random);
      while (read_at < due) read_at += between_reads(random);
      last = std::max(read_at, last + 1e-6);  // what is read at once is received a microsecond apart
      const hand_input::RawSample sample{stream.stamp(last), Vector3d(measured, 0.0, 0.0), Quaterniond::Identity()};
      ++sent;
      if (!hand_input::usable(gate.offer(sample))) continue;
      const double before = track.empty() ? sample.t : track.end();
      used += track.push({sample.t, make_transform(sample.p, sample.q)});
      if (track.begin() < before) {
        for (int i = 0; i <= 20; ++i) {
          const double t = before - 1e-9 + 0.05 * i * (sample.t - before);
          if (t < track.begin()) continue;
          farthest = std::max(farthest, std::abs(track.segment(t).at(t).X.translation().x() - t));
        }
      }
    }
    std::cout << rate << " Hz: " << used << " of " << sent << " samples, way between them off by " << farthest
              << " m\n";
    EXPECT_GT(used, sent / 3);
    EXPECT_LT(farthest, 0.05);  // the longest time between reads, at 1 m/s
  }
}

}  // namespace
}  // namespace spring_workbench::fastrak::cadence_clock_test
