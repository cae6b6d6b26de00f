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
           config::number_option("rate", validation::between(0.1, 1e4), options.rate),
           config::number_option("speed", validation::between(0.01, 1e3), options.speed),
           config::number_option("duration", validation::not_negative(), options.duration),
           {"switch", add_switch},
           {"fault", [&](const std::string& f) { options.faults.push_back(fastrak::parse_fault(f)); }},
           config::integer_option("seed", 0, std::numeric_limits<int>::max(), options.seed)})) {
    return std::nullopt;
  }
  if (options.motions.empty())
    validation::refuse(command_line, "--motion", "(nothing)", "the path of a motion file or script");
  return options;
}

std::string help_text() {
  return R"(A FASTRAK on a pseudo-terminal: understands its commands, plays motions, and fails on demand.

fastrak_simulator --motion FILE [--motion FILE ...] [--link PATH] [--rate HZ] [--speed X] [--duration S]
                  [--switch K ...] [--fault KIND[,rate=R][,from=S][,until=S] ...] [--seed N]

  --motion    what a station does: lines of `t x y z qx qy qz qw [button]` (s, m, -, 0 or 1), or a script (*.yaml) of
              waypoints; the receiver in the transmitter's frame, round and round. The first is that of station 1, whose
              button is the stylus'; up to four
  --link      a symbolic link to the pseudo-terminal, whose path is printed on standard output in any case
  --rate      records per second of all stations together, 0.1 ... 10000; 120, as the device
  --speed     of the device's clock, 0.01 ... 1000; 1
  --duration  of the device's clock [s]; 0: until it is interrupted
  --switch    station K, 2 ... 4, has a stylus whose switch works, too: its motion's button. Of the maker's device
              that of station 1 alone does, of devices that emulate it others may
  --fault     what goes wrong from `from` to `until` [s; 0, for ever], with the part `rate` (0 ... 1; 1) of the records:
              garbage     random bytes before, in or after a record, or a bit that is wrong
              cut         a stretch of a record is missing
              error       error letters, and error records between the data
              silence     nothing passes in either direction
              wrong_mode  at `from` the device streams inches in ASCII with its default list
              unplug      the pseudo-terminal is gone; afterwards there is a new one, the device as at power-on
              May be given several times.
  --seed      of the faults; 1

On SIGINT, SIGTERM or after --duration it says how many records it sent, and how many it dropped because nobody read.
Exit status: 0 done; 1 failed; 2 bad arguments or motion, with one line on standard error.
)";
}

}  // namespace spring_workbench::fastrak_simulator
