#include "options.h"

#include <getopt.h>
#include <yaml-cpp/yaml.h>

#include <limits>

#include "spring_workbench/config/yaml_fields.h"
#include "spring_workbench/fastrak/fastrak_protocol.h"

namespace spring_workbench::fastrak_simulator {
namespace {

const char* const kWhere = "command line";

std::vector<char*> without_remappings(int argc, char** argv) {
  std::vector<char*> words;
  for (int i = 0; i < argc; ++i) {
    if (std::string(argv[i]).find(":=") == std::string::npos) words.push_back(argv[i]);
  }
  return words;
}

double number(const std::string& option, const validation::NumberRule& rule) {
  return config::read_number(YAML::Node(std::string(optarg)), kWhere, option, rule);
}

}  // namespace

Options parse_options(int argc, char** argv) {
  enum Code { help = 1, motion, link, rate, speed, duration, with_switch, fault, seed };
  const option known[] = {{"help", no_argument, nullptr, help},
                          {"motion", required_argument, nullptr, motion},
                          {"link", required_argument, nullptr, link},
                          {"rate", required_argument, nullptr, rate},
                          {"speed", required_argument, nullptr, speed},
                          {"duration", required_argument, nullptr, duration},
                          {"switch", required_argument, nullptr, with_switch},
                          {"fault", required_argument, nullptr, fault},
                          {"seed", required_argument, nullptr, seed},
                          {nullptr, 0, nullptr, 0}};
  std::vector<char*> words = without_remappings(argc, argv);
  const int count = static_cast<int>(words.size());
  words.push_back(nullptr);
  Options options;
  opterr = 0;
  for (int code; (code = getopt_long(count, words.data(), ":", known, nullptr)) != -1;) {
    switch (code) {
      case help:
        options.help = true;
        return options;
      case motion:
        options.motions.emplace_back(optarg);
        break;
      case link:
        options.link = optarg;
        break;
      case rate:
        options.rate = number("--rate", validation::between(0.1, 1e4));
        break;
      case speed:
        options.speed = number("--speed", validation::between(0.01, 1e3));
        break;
      case duration:
        options.duration = number("--duration", validation::not_negative());
        break;
      case with_switch:
        options.switches.push_back(
            config::read_integer(YAML::Node(std::string(optarg)), kWhere, "--switch", 2, fastrak::kFastrakStations));
        break;
      case fault:
        options.faults.push_back(fastrak::parse_fault(optarg));
        break;
      case seed:
        options.seed = static_cast<unsigned>(config::read_integer(YAML::Node(std::string(optarg)), kWhere, "--seed", 0,
                                                                  std::numeric_limits<int>::max()));
        break;
      case ':':
        validation::refuse(kWhere, words[static_cast<std::size_t>(optind - 1)], "(nothing)", "followed by a value");
      default:
        validation::refuse(kWhere, "option", words[static_cast<std::size_t>(optind - 1)],
                           "one of those that --help lists");
    }
  }
  if (optind < count)
    validation::refuse(kWhere, "argument", words[static_cast<std::size_t>(optind)], "an option that --help lists");
  if (options.motions.empty())
    validation::refuse(kWhere, "--motion", "(nothing)", "the path of a motion file or script");
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
