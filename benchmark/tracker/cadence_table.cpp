#include "cadence_table.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <random>
#include <thread>

#include "motions.h"
#include "spring_workbench/fastrak/fastrak_source.h"
#include "spring_workbench/fastrak/station_stream.h"
#include "spring_workbench/hand_input/sample_gate.h"
#include "spring_workbench/simulated_fastrak/fastrak_simulator.h"

namespace spring_workbench {
namespace {

using std::chrono::duration;
using std::chrono::steady_clock;

constexpr double kDropout = 0.5;  // [s]
constexpr double kLearn = 10.0;   // [s] excluded at the start

class Spread {
 public:
  void add(double x) {
    ++count_;
    const double step = x - mean_;
    mean_ += step / static_cast<double>(count_);
    squares_ += step * (x - mean_);
  }
  std::size_t count() const { return count_; }
  double deviation() const { return count_ > 0 ? std::sqrt(squares_ / static_cast<double>(count_)) : 0.0; }

 private:
  std::size_t count_ = 0;
  double mean_ = 0.0, squares_ = 0.0;
};

/// Jitter of a stream, relative to the true times of measurement if these are known, otherwise from the intervals.
class Jitter {
 public:
  explicit Jitter(bool truth_known) : truth_known_(truth_known) {}

  void take(const motion::StationSample& sample, double measured) {
    const double stamp = stream_.stamp(sample.received);
    if (begin_ < 0.0) begin_ = sample.received;
    const bool used = hand_input::usable(gate_.offer({stamp, sample.p_TS, sample.q_TS}));
    if (used && sample.received - begin_ > kLearn) {
      const double interval = sample.received - last_received_;
      if (truth_known_) {
        before_.add(sample.received - measured);
        after_.add(stamp - measured);
      }
      intervals_.push_back({interval, stamp - last_stamp_});
    }
    if (used) last_received_ = sample.received, last_stamp_ = stamp;
  }

  void write(const std::string& stream, const std::string& line, std::ostream& out) {
    std::sort(intervals_.begin(), intervals_.end(),
              [](const Interval& a, const Interval& b) { return a.receipts < b.receipts; });
    const double usual = intervals_.empty() ? 0.0 : intervals_[intervals_.size() / 2].receipts;
    for (const Interval& interval : intervals_) {
      if (interval.stamps > 1.5 * usual) ++breaks_;
      // Records are missing here, or are assumed lost.
      if (truth_known_ || std::max(interval.receipts, interval.stamps) > 1.5 * usual) continue;
      before_.add(interval.receipts / std::sqrt(2.0));
      after_.add(interval.stamps / std::sqrt(2.0));
    }
    out << stream << ',' << line << ',' << before_.count() << ',' << 1e3 * usual << ',' << 1e3 * before_.deviation()
        << ',' << 1e3 * after_.deviation() << ',' << breaks_ << std::endl;
  }

 private:
  struct Interval {
    double receipts, stamps;  ///< [s]
  };

  const bool truth_known_;
  fastrak::StationStream stream_{kDropout, true};
  hand_input::SampleGate gate_{hand_input::InputSettings(), kDropout};
  double begin_ = -1.0, last_received_ = -1.0, last_stamp_ = -1.0;
  Spread before_, after_;
  std::size_t breaks_ = 0;  ///< gaps of stamps: more than one and a half intervals
  std::vector<Interval> intervals_;
};

motion::StationSample received(const motion::StylusSample& sample, double t) {
  return {1, t, sample.X.translation(), Quaterniond(sample.X.linear()), false, ' '};
}

/// The samples with increasing stamps, since a line preserves the order of records.
std::vector<motion::StylusSample> in_order(const std::string& path) {
  std::vector<motion::StylusSample> samples;
  for (const motion::StylusSample& sample : read_samples(path)) {
    if (samples.empty() || sample.t > samples.back().t) samples.push_back(sample);
  }
  return samples;
}

void as_recorded(const std::string& path, std::ostream& out) {
  Jitter jitter(false);
  for (const motion::StylusSample& sample : in_order(path)) jitter.take(received(sample, sample.t), sample.t);
  jitter.write(file_name(path), "as recorded", out);
}

/// The samples of a motion, measured evenly at its mean rate, over a line with delays: exponentially distributed with
/// mean `delay` [s], plus the wait for the next poll of an adapter with period `poll` [s], if there is one.
void delayed(const std::string& path, double delay, double poll, const std::string& line, std::ostream& out) {
  const std::vector<motion::StylusSample> samples = in_order(path);
  const double interval = (samples.back().t - samples.front().t) / static_cast<double>(samples.size() - 1);
  std::mt19937 random(1);
  std::exponential_distribution<double> delays(1.0 / delay);
  Jitter jitter(true);
  double last = -1.0;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const double measured = static_cast<double>(i) * interval;
    double came = measured + delays(random);
    if (poll > 0.0) came = std::ceil(came / poll) * poll;
    last = std::max(came, last + 1e-6);
    jitter.take(received(samples[i], last), measured);
  }
  jitter.write(file_name(path), line, out);
}

/// The simulator in a separate thread, at 120 records per second and station; the x coordinate of a hand encodes the
/// time of measurement.
void simulated(int stations, std::ostream& out) {
  constexpr double length = 40.0, rate = 120.0, speed = 0.02;  // [s], [Hz] of a station, [m/s]
  std::vector<motion::StylusSample> way(2);
  way[1].t = length;
  way[0].X.translation() = Vector3d(0.3, 0.0, 0.4);
  way[1].X.translation() = Vector3d(0.3 + speed * length, 0.0, 0.4);
  const auto folder = std::filesystem::temp_directory_path() / ("cadence_" + std::to_string(std::random_device()()));
  std::filesystem::create_directory(folder);
  fastrak::FastrakSettings settings;
  settings.port = folder / "port";
  settings.stations.clear();
  for (int station = 1; station <= stations; ++station) settings.stations.push_back(station);
  simulated_fastrak::FastrakSimulator simulator(
      simulated_fastrak::FastrakDevice(
          std::vector<simulated_fastrak::PlayedMotion>(settings.stations.size(), simulated_fastrak::PlayedMotion(way))),
      simulated_fastrak::LineFaults(), settings.port);
  const auto start = steady_clock::now();
  std::atomic<bool> over{false};
  std::thread device([&] {
    for (long cycle = 0; !over; ++cycle) {
      const double t = static_cast<double>(cycle) / (rate * stations);
      std::this_thread::sleep_until(start + std::chrono::duration_cast<steady_clock::duration>(duration<double>(t)));
      simulator.serve(0.0);
      simulator.measure(t);
    }
  });
  std::vector<Jitter> jitter(settings.stations.size(), Jitter(true));
  {
    fastrak::FastrakSource source(settings);
    while (steady_clock::now() - start < duration<double>(length - 1.0)) {
      for (motion::StationSample sample : source.read(0.1)) {
        sample.received -= duration<double>(start.time_since_epoch()).count();
        jitter[static_cast<std::size_t>(sample.station - 1)].take(sample, (sample.p_TS.x() - 0.3) / speed);
      }
    }
  }
  over = true;
  device.join();
  std::filesystem::remove_all(folder);
  for (std::size_t i = 0; i < jitter.size(); ++i) {
    jitter[i].write("simulator station " + std::to_string(i + 1) + " of " + std::to_string(stations), "pseudo-terminal",
                    out);
  }
}

}  // namespace

void write_cadence_table(const std::vector<std::string>& motions, std::ostream& out) {
  out << "stream,line,samples,usual interval [ms],jitter of receipts [ms],jitter of stamps [ms],breaks of stamps\n";
  for (const std::string& path : motions) {
    as_recorded(path, out);
    delayed(path, 0.003, 0.0, "delays of 3 ms", out);
    delayed(path, 0.003, 0.016, "delays of 3 ms and a 16 ms poll", out);
  }
  for (const int stations : {1, 4}) simulated(stations, out);
}

}  // namespace spring_workbench
