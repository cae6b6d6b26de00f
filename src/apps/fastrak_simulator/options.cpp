#include "options.h"

#include <algorithm>
#include <limits>

#include "spring_workbench/config/command_line.h"
#include "spring_workbench/fastrak/fastrak_protocol.h"

namespace spring_workbench::fastrak_simulator {
using config::command_line;

std::optional<Options> parse_options(int argc, char** argv) {
  const auto is_remapping = [](const char* word) { return std::string(word).find(":=") != std::string::npos; };
  std::vector<char*> words(argv, argv + argc);
  words.erase(std::remove_if(words.begin(), words.end(), is_remapping), words.end());
  const int count = static_cast<int>(words.size());
  words.push_back(nullptr);
  Options options;
  const auto add_switch = [&](const std::string& station) {
    options.switches.push_back(
        config::read_integer(YAML::Node(station), command_line, "--switch", 2, fastrak::kFastrakStations));
  };
  if (!config::read_command_line(
          count, words.data(),
          {{"motion", [&](const std::string& path) { options.motions.push_back(path); }},
           config::text_option("link", options.link),
           config::number_option("rate", validation::between(0.1, 1e4).in("Hz"), options.rate),
           config::number_option("speed", validation::between(0.01, 1e3), options.speed),
           config::number_option("duration", validation::not_negative().in("s"), options.duration),
           {"switch", add_switch},
           {"fault", [&](const std::string& f) { options.faults.push_back(simulated_fastrak::parse_fault(f)); }},
           config::integer_option("seed", 0, std::numeric_limits<int>::max(), options.seed)})) {
    return std::nullopt;
  }
  if (options.motions.empty()) validation::refuse_missing(command_line, "--motion", "path of a motion file or script");
  return options;
}

std::string help_text() {
  return R"(Simulates a FASTRAK on a pseudo-terminal: understands its commands, plays motions, and fails on demand.

fastrak_simulator --motion FILE [--motion FILE ...] [--link PATH] [--rate HZ] [--speed X] [--duration S]
                  [--switch K ...] [--fault KIND[,rate=R][,from=S][,until=S] ...] [--seed N]

  --motion    the motion of a station: lines of `t x y z qx qy qz qw [button]` (s, m, -, 0 or 1), or a script (*.yaml)
              of waypoints; poses of the receiver in the transmitter's frame, played in a loop. The first one is for
              station 1, with the button of the stylus; up to four
  --link      a symbolic link to the pseudo-terminal, whose path is printed on standard output in any case
  --rate      records per second of all stations together, 0.1 ... 10000; default 120, like the device
  --speed     speed of the device's clock, 0.01 ... 1000; default 1
  --duration  run time by the device's clock [s]; 0, the default: until interrupted
  --switch    the switch of station K, 2 ... 4, also works, with the button of its motion. An original device has only
              the switch of station 1; devices that emulate it may have others
  --fault     a fault `from` (default 0) `until` (forever) [s] in a fraction `rate` (default 1) of the records:
              garbage     random bytes before, in or after a record, or a bit that is wrong
              cut         a stretch of a record is missing
              error       error letters, and error records between the data
              silence     nothing is transmitted in either direction
              wrong_mode  from `from` on the device streams inches in ASCII with its default list
              unplug      the pseudo-terminal disappears; afterwards there is a new one, with the device as at power-on
              May be given several times.
  --seed      seed of the faults; default 1

On SIGINT, SIGTERM or after --duration it prints how many records it sent, and how many it dropped because
they were not read.
Exit status: 0 done; 1 failed; 2 bad arguments or motion, with one line on standard error.
)";
}

}  // namespace spring_workbench::fastrak_simulator
