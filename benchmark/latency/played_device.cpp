#include "benchmark/latency/played_device.h"

#include <algorithm>
#include <chrono>
#include <stdexcept>
#include <string>
#include <thread>

namespace spring_workbench::benchmark {
namespace {

using std::chrono::steady_clock;

constexpr double kTolerance = 1e-7;  // [m] of the floats on the line

}  // namespace

double steady_now() { return std::chrono::duration<double>(steady_clock::now().time_since_epoch()).count(); }

std::vector<Moment> play(simulated_fastrak::FastrakSimulator& simulator, const simulated_fastrak::PlayedMotion& motion,
                         const Playing& playing, const std::function<bool()>& ready) {
  const double cycles = playing.rate * playing.stations;  // [Hz]
  const auto wait_for_cycle = [&](double start, long cycle) {
    simulator.serve(0.0);
    std::this_thread::sleep_until(steady_clock::time_point(std::chrono::duration_cast<steady_clock::duration>(
        std::chrono::duration<double>(start + static_cast<double>(cycle) / cycles))));
  };
  // While the nodes start and set up the device, it already measures at the same rate, from which the driver learns its
  // clock.
  const double before = steady_now();
  for (long cycle = 1; !ready(); ++cycle) {
    wait_for_cycle(before, cycle);
    simulator.measure(0.0);
  }
  std::vector<Moment> written;
  const double start = steady_now();
  for (long cycle = 1; static_cast<double>(cycle) <= playing.until * cycles; ++cycle) {
    const double t = static_cast<double>(cycle) / cycles;
    wait_for_cycle(start, cycle);
    const double begin = steady_now();
    simulator.measure(t);
    // A record at the very start equals those of the rest before it.
    if (t > playing.begin + 0.5 / cycles && t < playing.end && simulator.device().last_station() == playing.counted)
      written.push_back({begin, motion.at(t).X.translation().x()});
  }
  return written;
}

std::vector<double> latencies(const std::vector<Moment>& written, std::vector<Moment> observed, double offset) {
  std::vector<double> result;
  for (std::size_t i = observed.size(); i-- > 1;) observed[i - 1].x = std::min(observed[i - 1].x, observed[i].x);
  std::size_t i = 0;
  for (const Moment& record : written) {
    while (i < observed.size() && observed[i].x - offset < record.x - kTolerance) ++i;
    if (i < observed.size()) result.push_back(observed[i].t - record.t);
  }
  if (result.size() < 10) {
    throw std::runtime_error("only " + std::to_string(result.size()) + " of " + std::to_string(written.size()) +
                             " records were seen again");
  }
  std::sort(result.begin(), result.end());
  return result;
}

double quantile(const std::vector<double>& sorted, double part) {
  return sorted.empty() ? 0.0 : sorted[static_cast<std::size_t>(part * static_cast<double>(sorted.size() - 1))];
}

}  // namespace spring_workbench::benchmark
