#include <iostream>

#include "benchmark/soak/day.h"
#include "benchmark/soak/judge.h"
#include "spring_workbench/config/yaml_fields.h"
#include "spring_workbench/simulation/simulation.h"

/// live_day: a day-long live session with random faults, and its replay.
int main(int argc, char** argv) {
  using namespace spring_workbench;
  using benchmark::judge;
  constexpr double memory_growth = 1.01;
  try {
    if (argc < 4) {
      validation::refuse("command line", "arguments", "HOURS SCENE.urdf MOTION [MOTION ...]");
    }
    benchmark::DayOptions options;
    options.hours =
        config::read_number(YAML::Node(std::string(argv[1])), "command line", "HOURS", validation::positive().in("h"));
    options.scene = argv[2];
    options.motions.assign(argv + 3, argv + argc);
    const benchmark::DayResult r = benchmark::run_day(options, std::cout);
    for (const auto& [name, count] : r.faults) std::cout << name << ": " << count << '\n';
    std::cout << r.hours << " h, " << r.samples << " samples, an object held in " << r.held_ticks << " of " << r.ticks
              << " cycles, " << r.lives << " lives, " << r.changes << " changes, " << r.comparisons
              << " comparisons with the replay, hash " << math::to_hex(r.hash) << '\n';
    return judge(r.finite, "everything is finite") | judge(r.hash == r.replay_hash, "the hash is the replay's") |
           judge(r.mismatches == 0, "each change, made again, led to the recorded state") |
           judge(r.restarts <= r.lives, "time restarted at the first sample of a life alone") |
           judge(r.lost_states == 0, "no object was elsewhere after a new master") |
           judge(r.memory_late <= memory_growth * r.memory_early, "memory in use as a life begins is flat within 1 %");
  } catch (const validation::InputError& error) {
    std::cerr << "live_day: " << error.what() << '\n';
    return 2;
  }
}
