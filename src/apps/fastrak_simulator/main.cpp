#include <algorithm>
#include <chrono>
#include <csignal>
#include <iostream>
#include <utility>

#include "constants.h"
#include "options.h"
#include "spring_workbench/config/command_line.h"
#include "spring_workbench/motion_files/open_motion.h"
#include "spring_workbench/simulated_fastrak/fastrak_simulator.h"

namespace spring_workbench::fastrak_simulator {
namespace {

using std::chrono::duration;
using std::chrono::steady_clock;

volatile std::sig_atomic_t interrupted = 0;

simulated_fastrak::PlayedMotion read_motion(const std::string& path) {
  const auto source = motion_files::open_motion(path);
  std::vector<motion::StylusSample> samples;
  while (const auto sample = source->next()) samples.push_back(*sample);
  return simulated_fastrak::PlayedMotion(samples, path);
}

/// Serves the host until a moment of the wall clock.
void serve_until(simulated_fastrak::FastrakSimulator& simulator, steady_clock::time_point moment) {
  while (interrupted == 0) {
    const double left = duration<double>(moment - steady_clock::now()).count();
    if (left <= 0.0) break;
    // Waits for the host in whole milliseconds; the loop below sleeps for the rest, so that cycles are even.
    if (left > 1e-3) {
      simulator.serve(std::min(left - 1e-3, longest_wait));
    } else {
      simulator.serve(0.0);
      timespec rest{0, static_cast<long>(std::min(left, 2e-4) * 1e9)};
      nanosleep(&rest, nullptr);
    }
  }
}

/// Runs the device until the duration is over or the program is interrupted.
void run(const Options& options) {
  std::signal(SIGINT, [](int) { interrupted = 1; });
  std::signal(SIGTERM, [](int) { interrupted = 1; });
  std::vector<simulated_fastrak::PlayedMotion> motions;
  for (const std::string& path : options.motions) motions.push_back(read_motion(path));
  simulated_fastrak::FastrakSimulator simulator(
      simulated_fastrak::FastrakDevice(std::move(motions), options.switches),
      simulated_fastrak::LineFaults(options.faults, static_cast<unsigned>(options.seed)), options.link);
  std::string path;
  const auto start = steady_clock::now();
  for (long cycle = 0; interrupted == 0; ++cycle) {
    const double t = static_cast<double>(cycle) / options.rate;
    if (options.duration > 0.0 && t >= options.duration) break;
    serve_until(simulator,
                start + std::chrono::duration_cast<steady_clock::duration>(duration<double>(t / options.speed)));
    simulator.serve(0.0);
    simulator.measure(t);
    if (simulator.path() != path) {
      path = simulator.path();
      std::cout << (path.empty() ? "unplugged" : path) << std::endl;
    }
  }
  std::cout << simulator.records_sent() << " records sent, " << simulator.records_dropped()
            << " dropped because no program read them" << std::endl;
}

}  // namespace
}  // namespace spring_workbench::fastrak_simulator

int main(int argc, char** argv) {
  using namespace spring_workbench;
  return config::run_program(
      "fastrak_simulator", fastrak_simulator::help_text(), [&] { return fastrak_simulator::parse_options(argc, argv); },
      fastrak_simulator::run);
}
