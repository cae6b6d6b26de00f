#include "options.h"

#include <filesystem>
#include <utility>

#include "spring_workbench/assembly/task_score.h"
#include "spring_workbench/config/command_line.h"
#include "tools.h"

namespace spring_workbench::assembly_trials {
using config::command_line;
namespace {

/// Whether two paths name one file; /dev/null and pipes may be given twice.
bool is_same_file(const std::filesystem::path& a, const std::filesystem::path& b) {
  const auto whole = [](const auto& path) {
    return std::filesystem::weakly_canonical(std::filesystem::absolute(path));
  };
  return whole(a) == whole(b) && (!std::filesystem::exists(a) || std::filesystem::is_regular_file(a));
}

/// Refuses two outputs with one path, of which only the second would remain.
void check_files(const Options& options) {
  const std::pair<const char*, std::string> files[] = {
      {"--out", options.out}, {"--table", options.table}, {"--record", options.record}};
  for (const auto& a : files) {
    for (const auto& b : files) {
      if (&a == &b || a.second.empty() || b.second.empty() || !is_same_file(a.second, b.second)) continue;
      throw validation::InputError(std::string(command_line) + ": " + a.first + ", " + b.first +
                                   ": must be different files");
    }
  }
}

}  // namespace

std::optional<Options> parse_options(int argc, char** argv) {
  Options options;
  const auto settings = [&](const std::string& path) {
    simulation::apply_settings(config::load_yaml_file(path), path, options.settings);
  };
  const auto tool = [&](const std::string& label) {
    options.tool = config::read_choice(YAML::Node(label), command_line, "--tool", tool_labels());
  };
  if (!config::read_command_line(
          argc, argv,
          {config::text_option("scene", options.scene),
           {"settings", settings},
           {"tool", tool},
           config::integer_option("trials", 1, 10000, options.trials),
           config::integer_option("seed", 0, 1000000000, options.seed),
           config::number_option("rate", validation::between(1.0, 1000.0).in("Hz"), options.hand.rate),
           config::number_option("delay", validation::between(0.0, 2.0).in("s"), options.hand.reaction),
           config::number_option("noise", validation::between(0.0, 0.1).in("m"), options.hand.position_noise),
           config::number_option("angle-noise", validation::between(0.0, 1.0).in("rad"), options.hand.angle_noise),
           config::number_option("scatter", validation::between(0.0, 0.5), options.hand.aim_scatter),
           config::number_option("time-limit", validation::between(1.0, 1e5).in("s"), options.time_limit),
           config::text_option("out", options.out),
           config::text_option("table", options.table),
           config::text_option("record", options.record)})) {
    return std::nullopt;
  }
  if (options.scene.empty()) validation::refuse_missing(command_line, "--scene", "path of a URDF scene with targets");
  check_files(options);
  return options;
}

std::string csv_header() { return "participant,order,condition,trial,practice," + assembly::score_csv_header(); }

std::string help_text() {
  std::string columns = csv_header();
  columns.insert(columns.find("collisions"), "\n              ");
  return R"(A simulated operator assembles a scene with one tool after another, without a person, ROS or a clock.
The same arguments give bit-identical output.

assembly_trials --scene SCENE.urdf [--settings FILE.yaml] [--tool LABEL] [--trials N] [--seed S] [--out TRIALS.csv]
                [--rate HZ] [--delay S] [--noise M] [--angle-noise RAD] [--scatter SHARE] [--time-limit S]
                [--table TABLE.csv] [--record HAND.tum]

  --scene     a scene whose YAML file has targets: path or package:// URI of the URDF
  --settings  a YAML file of settings for all tools: the keys of replay except rate and input.*
  --tool      one tool only: )" +
         validation::join(tool_labels()) + R"(; default: each of them
  --trials    number of trials per tool; default 20
  --seed      seed of the first trial, which increases by 1 per trial; default 1
  --rate      samples of the tracked hand per second [Hz]; default 50
  --delay     the operator sees everything this late [s]; default 0.2
  --noise, --angle-noise  of the tracker, per axis and sample: standard deviations [m], [rad]; default 1e-4, 5e-4
  --scatter   standard deviation of a reach's end point, per axis, as a fraction of the reach's length; default 0.02
  --time-limit  of a trial [s]; default 300
  --out       a line of CSV per trial:
              )" +
         columns + R"(
              participant is the seed, condition the tool, order its place in the list above; columns of a study
              with people
  --table     a table of the means of each tool with 95 % confidence intervals, in CSV
  --record    the hand of the first trial as a motion file for replay and tracker_driver; the second hand of an
              operator with two goes to HAND_2.tum

Without --out the lines go to standard output. Exit status: 0 done; 1 failed; 2 bad arguments or input, with one line on
standard error.
)";
}

}  // namespace spring_workbench::assembly_trials
