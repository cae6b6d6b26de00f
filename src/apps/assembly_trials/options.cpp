#include "options.h"

#include <getopt.h>

#include "spring_workbench/assembly/task_score.h"
#include "spring_workbench/config/yaml_fields.h"
#include "tools.h"

namespace spring_workbench::assembly_trials {
namespace {

const char* const kWhere = "command line";

int whole_number(const std::string& option, const char* text, int min, int max) {
  return config::read_integer(YAML::Node(std::string(text)), kWhere, option, min, max);
}

}  // namespace

Options parse_options(int argc, char** argv) {
  enum { help, scene, settings, tool, trials, seed, out, table, record };
  const option known[] = {{"help", no_argument, nullptr, help},
                          {"scene", required_argument, nullptr, scene},
                          {"settings", required_argument, nullptr, settings},
                          {"tool", required_argument, nullptr, tool},
                          {"trials", required_argument, nullptr, trials},
                          {"seed", required_argument, nullptr, seed},
                          {"out", required_argument, nullptr, out},
                          {"table", required_argument, nullptr, table},
                          {"record", required_argument, nullptr, record},
                          {nullptr, 0, nullptr, 0}};
  Options options;
  opterr = 0;
  for (int code; (code = getopt_long(argc, argv, ":", known, nullptr)) != -1;) {
    switch (code) {
      case help:
        options.help = true;
        return options;
      case scene:
        options.scene = optarg;
        break;
      case settings:
        simulation::apply_settings(config::load_yaml_file(optarg), optarg, options.settings);
        break;
      case tool:
        options.tool = config::read_choice(YAML::Node(std::string(optarg)), kWhere, "--tool", tool_labels());
        break;
      case trials:
        options.trials = whole_number("--trials", optarg, 1, 10000);
        break;
      case seed:
        options.seed = whole_number("--seed", optarg, 0, 1000000000);
        break;
      case out:
        options.out = optarg;
        break;
      case table:
        options.table = optarg;
        break;
      case record:
        options.record = optarg;
        break;
      case ':':
        validation::refuse(kWhere, argv[optind - 1], "(nothing)", "followed by a value");
      default:
        validation::refuse(kWhere, "option", argv[optind - 1], "one of those that --help lists");
    }
  }
  if (optind < argc) validation::refuse(kWhere, "argument", argv[optind], "an option that --help lists");
  if (options.scene.empty()) validation::refuse(kWhere, "--scene", "(nothing)", "a URDF of a scene with targets");
  return options;
}

std::string help_text() {
  return R"(A simulated operator assembles a scene with one tool after the other: no person, no ROS, no clock.
The same arguments give the same bytes out.

assembly_trials --scene SCENE.urdf [--settings FILE.yaml] [--tool LABEL] [--trials N] [--seed S] [--out TRIALS.csv]
                [--table TABLE.md] [--record HAND.tum]

  --scene     a scene whose YAML file has targets: path or package:// URI of the URDF
  --settings  a YAML file of settings, as of replay; of all tools
  --tool      one tool alone: )" +
         validation::join(tool_labels()) + R"(; default: each of them
  --trials    of each tool; default 20
  --seed      of the first trial; the others count up; default 1
  --out       a line of CSV per trial:
              tool,seed,)" +
         assembly::score_csv_header() + R"(
  --table     a table in Markdown of each tool's mean and its 95 % confidence interval
  --record    the hand of the first trial as a motion file: replay and tracker_driver play it

Without --out the lines go to standard output. Exit status: 0 done; 2 bad arguments or input, with one line on standard
error.
)";
}

}  // namespace spring_workbench::assembly_trials
