#pragma once

#include <cstdint>
#include <map>
#include <ostream>
#include <string>
#include <vector>

namespace spring_workbench::benchmark {

struct DayOptions {
  std::string scene;                 ///< path of a URDF with a movable object
  std::vector<std::string> motions;  ///< files; at least one
  double hours = 24.0;               ///< simulated
  unsigned seed = 1;
};

struct DayResult {
  double hours = 0.0;  ///< by the steady clock of the simulated host, its standstills included
  std::size_t samples = 0, held_ticks = 0, ticks = 0, entries = 0;
  std::map<std::string, std::size_t> faults;  ///< how often each was made to happen
  std::size_t lives = 0;                      ///< of the node: a new one after each new master
  std::size_t changes = 0, comparisons = 0, mismatches = 0;
  std::size_t restarts = 0;     ///< of the hands' time; each life has one, at its first sample
  std::size_t lost_states = 0;  ///< objects that a new life has elsewhere than the one before
  bool finite = true;
  double memory_early = 0.0, memory_late = 0.0;  ///< resident [bytes]: the most in the first tenth, and at the end
  std::uint64_t hash = 0, replay_hash = 0;       ///< of all states at the ends of lives
};

/// A long live run as the node `manipulation` makes it, without ROS and on clocks of its own: two hands that loop
/// recordings, as two of four stations at 30 Hz, through stream clocks, feed and SimulationRunner; changes by services
/// at random; and faults at random, of the line (silence, garbage, records twice or out of order), of the clocks (of
/// either host, and standstills of the machine or the process), and of the master (a new one: the node ends and another
/// one goes on from its checkpoint). A Replayer repeats it from its journal at the same time, and compares each second.
/// Throws InputError where a file cannot be read or the replay differs. `out`: a line for each twentieth.
DayResult run_day(const DayOptions& options, std::ostream& out);

}  // namespace spring_workbench::benchmark
