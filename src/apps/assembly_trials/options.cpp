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
  if (options.scene.empty()) validation::refuse(command_line, "--scene", "", "a URDF of a scene with targets");
  return options;
}

std::string csv_header() { return "participant,order,condition,trial,practice," + assembly::score_csv_header(); }

std::string help_text() {
  return R"(A simulated operator assembles a scene with one tool after another, without a person, ROS or a clock.
The same arguments give bit-identical output.

assembly_trials --scene SCENE.urdf [--settings FILE.yaml] [--tool LABEL] [--trials N] [--seed S] [--out TRIALS.csv]
                [--table TABLE.md] [--record HAND.tum]

  --scene     a scene whose YAML file has targets: path or package:// URI of the URDF
  --settings  a YAML file of settings for all tools, as for replay
  --tool      one tool only: )" +
         validation::join(tool_labels()) + R"(; default: each of them
  --trials    number of trials per tool; default 20
  --seed      seed of the first trial, which increases by 1 per trial; default 1
  --out       a line of CSV per trial:
              )" +
         csv_header() + R"(
              participant is the seed, condition the tool, order its place in the list above; columns as of a study
              with people
  --table     a Markdown table of the means of each tool with 95 % confidence intervals
  --record    the hand of the first trial as a motion file for replay and tracker_driver

Without --out the lines go to standard output. Exit status: 0 done; 1 failed; 2 bad arguments or input, with one line on
standard error.
)";
}

}  // namespace spring_workbench::assembly_trials
