#include "spring_workbench/fastrak/fastrak_source.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <deque>
#include <iostream>
#include <optional>
#include <string>
#include <unordered_set>

#include "spring_workbench/simulated_fastrak/fastrak_simulator.h"
#include "support/played_motions.h"
#include "support/temporary_folder.h"

namespace spring_workbench::fastrak::fastrak_source_test {
namespace {

using namespace simulated_fastrak;

using std::chrono::duration;
using std::chrono::steady_clock;

constexpr double kRate = 120.0;     // records per second
constexpr double kDeadline = 20.0;  // [s] for anything here
constexpr int kStations = 2;

std::vector<PlayedMotion> hands() { return {test_support::circling_hand(0.5), test_support::circling_hand(0.9)}; }

double steady_now() { return duration<double>(steady_clock::now().time_since_epoch()).count(); }

/// A pose to the last bit of the device's floats.
std::string key(const FastrakRecord& record) {
  static const FastrakLayout layout({2, 11, 16, 0}, FastrakFormat::binary, FastrakUnits::centimetres);
  FastrakRecord plain = record;
  plain.error = ' ';
  return layout.encode(plain);
}

std::string key(const motion::StationSample& sample) {
  return key(FastrakRecord{sample.station, ' ', sample.p_TS, sample.q_TS, sample.button});
}

FastrakRecord sent_record(int station, const motion::StylusSample& truth) {
  return {station, ' ', truth.X.translation(), Quaterniond(truth.X.linear()), station == 1 && truth.button};
}

std::string key(int station, const motion::StylusSample& truth) { return key(sent_record(station, truth)); }

/// Rounding of a mode, half of the last digit: 0.01 cm and 0.01° or 1e-4 of a quaternion in each number; for binary
/// angles, that of floats in degrees.
struct Rounding {
  double position = 0.0;  ///< [m]
  double angle = 0.0;     ///< [rad]
};
Rounding rounding(const FastrakSettings& settings) {
  const bool binary = settings.format == FastrakFormat::binary;
  if (binary) return {1e-7, 1e-6};
  // Three numbers of half a digit each; half an angle is the quaternion's.
  return {std::sqrt(3.0) * 5e-5, settings.euler ? 3.0 * 0.005 * M_PI / 180.0 : 2.0 * std::sqrt(4.0) * 5e-5};
}

/// Simulator and source on one thread, so that a busy machine delays both alike.
class Bench {
 public:
  Bench(const std::vector<std::string>& faults, FastrakSettings settings) {
    std::vector<Fault> parsed;
    for (const std::string& fault : faults) parsed.push_back(parse_fault(fault));
    settings.port = folder_.path("port");
    simulator_.emplace(FastrakDevice(hands()), LineFaults(parsed, 5), settings.port);
    source_.emplace(settings);
    rounding_ = rounding(settings);
  }

  /// Runs until the wall's clock says `until` [s] since the first run.
  void run(double until) {
    while (now() < until) step();
  }

  /// Runs until a sample arrives; returns its time [s].
  double run_until_sample() {
    const std::size_t before = received_;
    const double give_up = now() + kDeadline;
    while (received_ == before && now() < give_up) step();
    EXPECT_GT(received_, before) << source_->health().text;
    return now();
  }

  void run_until_text(const std::string& text) {
    const double give_up = now() + kDeadline;
    while (source_->health().text.find(text) == std::string::npos && now() < give_up) step();
    EXPECT_NE(source_->health().text.find(text), std::string::npos) << source_->health().text;
  }

  double now() const { return duration<double>(steady_clock::now() - start_).count(); }
  const FastrakSource& source() const { return *source_; }
  std::size_t received() const { return received_; }
  /// Number of samples that do not equal a sent one bit for bit.
  std::size_t wrong() const { return wrong_; }
  /// Number of samples that differ from every sent one by more than the mode's rounding.
  std::size_t far() const { return far_; }

 private:
  void step() {
    simulator_->serve(0.0);
    for (const double t = now(); static_cast<double>(cycle_) / kRate <= t; ++cycle_) {
      const double due = static_cast<double>(cycle_) / kRate;
      for (int station = 1; station <= kStations; ++station) {
        const motion::StylusSample truth = hands_[static_cast<std::size_t>(station - 1)].at(due);
        sent_.insert(key(station, truth));
        poses_.push_back(sent_record(station, truth));
      }
      simulator_->measure(due);
    }
    for (const motion::StationSample& sample : source_->read(1e-3)) {
      ++received_;
      EXPECT_GT(sample.received, newest_);
      newest_ = sample.received;
      wrong_ += 1 - sent_.count(key(sample));
      const auto is_near = [&](const FastrakRecord& sent) {
        return sent.station == sample.station && sent.button == sample.button &&
               (sent.p_TS - sample.p_TS).norm() <= rounding_.position &&
               sent.q_TS.angularDistance(sample.q_TS) <= rounding_.angle;
      };
      far_ += std::none_of(poses_.begin(), poses_.end(), is_near) ? 1 : 0;
    }
  }

  const std::vector<PlayedMotion> hands_ = hands();
  test_support::TemporaryFolder folder_;
  std::optional<FastrakSimulator> simulator_;
  std::optional<FastrakSource> source_;
  steady_clock::time_point start_ = steady_clock::now();
  long cycle_ = 0;
  std::size_t received_ = 0, wrong_ = 0, far_ = 0;
  double newest_ = 0.0;
  std::unordered_set<std::string> sent_;
  std::vector<FastrakRecord> poses_;
  Rounding rounding_;
};

FastrakSettings two_stations() {
  FastrakSettings settings;
  settings.stations = {1, 2};
  return settings;
}

/// The reader's end of the line, observed independently.
class Line {
 public:
  explicit Line(const std::string& port) : file_(open(port.c_str(), O_RDONLY | O_NOCTTY | O_NONBLOCK)) {}
  ~Line() { close(file_); }
  Line(const Line&) = delete;
  Line& operator=(const Line&) = delete;
  /// Whether there is nothing to read.
  bool empty() const {
    int bytes = 0;
    return ioctl(file_, FIONREAD, &bytes) == 0 && bytes == 0;
  }

 private:
  int file_;
};

/// 120 Hz from each of four stations for ten minutes of the device's clock, as fast as the line takes them: what comes
/// is what was sent, to the bit and in order. The device sends on to the end: a pseudo-terminal that was full may keep
/// its last bytes until the next ones come. A line that stays empty for a quarter of a second has lost its stream by
/// rule; the kernel's own threads carry the bytes, and a busy machine takes the processor from them, too.
TEST(FastrakSource, LosesNoRecordInTenMinutesOfFourStations) {
  test_support::TemporaryFolder folder;
  const std::vector<PlayedMotion> motions(4, test_support::circling_hand());
  FastrakSimulator simulator(FastrakDevice(motions), LineFaults(), folder.path("port"));
  const Line line(folder.path("port"));
  FastrakSettings settings;
  settings.port = folder.path("port");
  settings.stations = {1, 2, 3, 4};
  FastrakSource source(settings);
  constexpr std::size_t records = 600 * 120 * 4;
  std::size_t received = 0, wrong = 0, idle = 0;
  std::deque<double> on_the_way;  // when they were measured [s]
  bool held_up = false;
  auto last_receipt = steady_clock::now();
  for (std::size_t cycle = 0; received < records && idle < 20000;) {
    held_up |= received > 0 && steady_clock::now() - last_receipt > std::chrono::milliseconds(100) && line.empty();
    if (held_up && source.health().counters["times the stream was lost"] > 0)
      GTEST_SKIP() << "the machine held up the line";
    simulator.serve(0.0);
    const bool room = simulator.waiting() == 0;
    for (int i = 0; simulator.waiting() == 0 && i < 16; ++i) {
      const double t = static_cast<double>(cycle++) / 480.0;
      const std::size_t before = simulator.records_sent();
      simulator.measure(t);
      if (simulator.records_sent() > before) on_the_way.push_back(t);
    }
    const auto samples = source.read(room ? 0.0 : 1e-3);
    idle = samples.empty() ? idle + 1 : 0;
    if (!samples.empty()) last_receipt = steady_clock::now();
    for (const motion::StationSample& sample : samples) {
      const auto is_next = [&] { return key(sample) == key(sample.station, motions[0].at(on_the_way.front())); };
      while (received == 0 && !on_the_way.empty() && !is_next()) on_the_way.pop_front();  // those of a restarted set-up
      ASSERT_FALSE(on_the_way.empty());
      const int station = static_cast<int>(received++ % 4) + 1;  // each in its turn
      wrong += is_next() && sample.station == station ? 0 : 1;
      on_the_way.pop_front();
    }
  }
  EXPECT_GE(received, records) << source.health().text;
  EXPECT_EQ(simulator.records_dropped(), 0u);
  EXPECT_EQ(wrong, 0u);
  auto counters = source.health().counters;
  EXPECT_EQ(counters["records"], received);
  EXPECT_EQ(counters["bytes skipped"], 0u);
  EXPECT_EQ(counters["times the stream was lost"], 0u);
}

TEST(FastrakSource, ReadsEveryModeThatItCanAskFor) {
  for (const auto format : {FastrakFormat::ascii, FastrakFormat::binary}) {
    for (const int variant : {0, 1, 2, 3}) {
      FastrakSettings settings = two_stations();
      settings.format = format;
      settings.euler = (variant & 1) != 0;
      settings.redundant = (variant & 2) != 0;
      Bench bench({}, settings);
      for (int i = 0; i < 20; ++i) bench.run_until_sample();
      const bool exact = format == FastrakFormat::binary && !settings.euler;
      EXPECT_TRUE(!exact || bench.wrong() == 0);
      EXPECT_EQ(bench.far(), 0u) << exact << variant;
      EXPECT_TRUE(bench.source().health().streaming);
      EXPECT_EQ(bench.source().health().counters.at("bytes skipped"), 0u);
      EXPECT_EQ(bench.source().health().counters.at("errors reported by the device"), 0u);
    }
  }
}

struct NamedFault {
  const char* fault;
  double over;  ///< [s] when it is over
};
class Faults : public testing::TestWithParam<NamedFault> {};

/// A fault from 0.3 s on: no pose passes that was not sent, and good ones return. The time is printed; a busy machine
/// may take longer.
TEST_P(Faults, PassNoWrongPoseAndEnd) {
  Bench bench({std::string(GetParam().fault) + ",from=0.3,until=0.6"}, two_stations());
  bench.run_until_sample();
  bench.run(GetParam().over);
  const double back = bench.run_until_sample() - GetParam().over;
  const std::size_t before = bench.received();
  bench.run(bench.now() + 0.2);
  EXPECT_GT(bench.received(), before);
  EXPECT_EQ(bench.wrong(), 0u);
  std::cout << "  " << GetParam().fault << ": good data " << back << " s after its end\n";
}
INSTANTIATE_TEST_SUITE_P(EachKind, Faults,
                         testing::Values(NamedFault{"garbage", 0.6}, NamedFault{"garbage,rate=0.3", 0.6},
                                         NamedFault{"cut", 0.6}, NamedFault{"cut,rate=0.3", 0.6},
                                         NamedFault{"error", 0.6}, NamedFault{"silence", 0.6},
                                         NamedFault{"wrong_mode", 0.3}, NamedFault{"unplug", 0.6}));

/// So that consumers never see intervals of zero.
TEST(FastrakSource, StampsRecordsThatAreReadTogetherOneAfterTheOther) {
  test_support::TemporaryFolder folder;
  FastrakSimulator simulator(FastrakDevice(hands()), LineFaults(), folder.path("port"));
  FastrakSettings settings = two_stations();
  settings.port = folder.path("port");
  FastrakSource source(settings);
  const double give_up = steady_now() + kDeadline;
  double t = 0.0;
  while (!source.health().streaming && steady_now() < give_up) {
    simulator.serve(0.0);
    simulator.measure(t += 0.01);
    source.read(1e-3);
  }
  const double before = steady_now();
  std::vector<motion::StationSample> samples;
  for (int i = 0; i < 6; ++i) simulator.measure(t += 0.01);
  while (samples.size() < 6 && steady_now() < give_up) {
    for (const motion::StationSample& sample : source.read(0.01)) samples.push_back(sample);
  }
  ASSERT_EQ(samples.size(), 6u);
  EXPECT_LE(samples.back().received, steady_now());
  EXPECT_GT(samples.back().received, before);
  for (std::size_t i = 1; i < samples.size(); ++i) EXPECT_GT(samples[i].received, samples[i - 1].received);
}

TEST(FastrakSource, TakesOverADeviceThatStreamsInAnotherMode) {
  Bench bench({"wrong_mode"}, two_stations());
  bench.run_until_sample();
  bench.run(0.5);
  EXPECT_EQ(bench.wrong(), 0u);
}

TEST(FastrakSource, ReportsWhatIsWrong) {
  FastrakSettings settings;
  settings.port = "/nonexistent/port";
  FastrakSource no_port(settings);
  EXPECT_TRUE(no_port.read(0.01).empty());
  EXPECT_NE(no_port.health().text.find("/nonexistent/port: no such port"), std::string::npos);
  EXPECT_FALSE(no_port.health().streaming);

  test_support::TemporaryFolder folder;
  folder.write("file", "no terminal");
  settings.port = folder.path("file");
  FastrakSource no_terminal(settings);
  no_terminal.read(0.01);
  EXPECT_NE(no_terminal.health().text.find("is not a serial port"), std::string::npos) << no_terminal.health().text;

  const PseudoTerminal terminal;
  settings.port = terminal.path();
  FastrakSource first(settings), second(settings);
  first.read(0.01);
  second.read(0.01);
  EXPECT_NE(second.health().text.find("in use by another program"), std::string::npos) << second.health().text;

  Bench silent({"silence"}, two_stations());
  silent.run_until_text("silent at 115200 baud");
  Bench unplugged({"unplug"}, two_stations());
  unplugged.run_until_text("no such port");
}

TEST(FastrakSource, SaysThatTheBytesAreNoFastraks) {
  PseudoTerminal terminal;
  FastrakSettings settings;
  settings.port = terminal.path();
  FastrakSource source(settings);
  const auto give_up = steady_clock::now() + duration<double>(kDeadline);
  while (source.health().text.find("is not a FASTRAK's") == std::string::npos && steady_clock::now() < give_up) {
    terminal.read(0.0);
    terminal.write("$GPGGA,123519,4807.038,N\r\n");
    EXPECT_TRUE(source.read(1e-3).empty());
  }
  EXPECT_NE(source.health().text.find("is not a FASTRAK's"), std::string::npos) << source.health().text;
}

TEST(FastrakSource, StopsTheStreamWhenItEnds) {
  PseudoTerminal terminal;
  FastrakSettings settings;
  settings.port = terminal.path();
  {
    FastrakSource source(settings);
    source.read(0.01);
    terminal.read(1.0);
  }
  EXPECT_EQ(terminal.read(kDeadline), "c");
}

TEST(LineFaults, AddEightyBytesOfNoiseAtMost) {
  LineFaults faults({Fault()}, 3);
  const std::string record(60, ' ');
  std::size_t longest = 0;
  for (int k = 0; k < 10000; ++k) longest = std::max(longest, faults.pass(record, 0.0).size());
  EXPECT_EQ(longest, record.size() + 80);
}

}  // namespace
}  // namespace spring_workbench::fastrak::fastrak_source_test
