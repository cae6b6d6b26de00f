#include "options.h"

#include "spring_workbench/assembly/task_score.h"
#include "spring_workbench/config/command_line.h"
#include "tools.h"

namespace spring_workbench::assembly_trials {
using config::command_line;

std::optional<Options> parse_options(int argc, char** argv) {
  Options options;
  const auto settings = [&](const std::string& path) {
    simulation::apply_settings(config::load_yaml_file(path), path, options.settings);
  };
  const auto tool = [&](const std::string& label) {
    options.tool = config::read_choice(YAML::Node(label), command_line, "--tool", tool_labels());
  };
  if (!config::read_command_line(argc, argv,
                                 {config::text_option("scene", options.scene),
                                  {"settings", settings},
                                  {"tool", tool},
                                  config::integer_option("trials", 1, 10000, options.trials),
                                  config::integer_option("seed", 0, 1000000000, options.seed),
                                  config::text_option("out", options.out),
                                  config::text_option("table", options.table),
                                  config::text_option("record", options.record)})) {
    return std::nullopt;
  }
  if (options.scene.empty()) validation::refuse(command_line, "--scene", "(nothing)", "a URDF of a scene with targets");
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
