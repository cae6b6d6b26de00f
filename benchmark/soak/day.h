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
  double hours = 0.0;  ///< by the steady clock of the simulated host, including its suspensions
  std::size_t samples = 0, held_ticks = 0, ticks = 0, entries = 0;
  std::map<std::string, std::size_t> faults;  ///< number of times that each was injected
  std::size_t lives = 0;                      ///< lives of the node: a new one after each restart of the master
  std::size_t changes = 0, comparisons = 0, mismatches = 0;
  std::size_t restarts = 0;     ///< restarts of the hands' time; each life has one, at its first sample
  std::size_t lost_states = 0;  ///< objects whose pose a new life did not restore
  bool finite = true;
  double memory_early = 0.0;                ///< heap in use as a life begins [bytes]: maximum in the first tenth
  double memory_late = 0.0;                 ///< of the last life
  std::uint64_t hash = 0, replay_hash = 0;  ///< of all states at the ends of lives
};

/// Runs a long live session like that of the node `manipulation`, without ROS and on simulated clocks. Two hands loop
/// recordings, as two of four stations at 30 Hz, through stream clocks, filter and SimulationRunner. Changes as by
/// services are made at random, and random faults are injected: of the line (silence, garbage, records repeated or out
/// of order), of the clocks (set on either host; machine suspended or process stopped), and of the master (restarted:
/// the node exits and another one resumes from its checkpoint). A Replayer replays the journal concurrently and
/// compares the states every second. Throws InputError if a file cannot be read or the replay differs. `out`: a line
/// for every 5 %.
DayResult run_day(const DayOptions& options, std::ostream& out);

}  // namespace spring_workbench::benchmark
