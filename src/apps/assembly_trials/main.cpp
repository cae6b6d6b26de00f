#include <filesystem>
#include <iomanip>
#include <iostream>
#include <sstream>

#include "options.h"
#include "spring_workbench/assembly/trial.h"
#include "spring_workbench/config/command_line.h"
#include "spring_workbench/config/output_file.h"
#include "table.h"
#include "tools.h"

namespace spring_workbench::assembly_trials {
namespace {

void write_file(const std::string& path, const std::string& text) {
  config::OutputFile file(path);
  file.write(text);
  file.commit();
}

/// The motion of a hand as a motion file (doc/reference.md), rounded to 10 µm and 10 µrad, which is below the tracker's
/// noise.
std::string motion_text(const std::vector<motion::StylusSample>& motion, std::size_t hand) {
  std::ostringstream text;
  text.imbue(std::locale::classic());
  text << "# t x y z qx qy qz qw button\n" << std::fixed;
  for (const motion::StylusSample& sample : motion) {
    if (sample.hand != hand) continue;
    const Vector3d& p = sample.X.translation();
    const Quaterniond q(sample.X.linear());
    text << std::setprecision(3) << sample.t << std::setprecision(5) << ' ' << p.x() << ' ' << p.y() << ' ' << p.z()
         << ' ' << q.x() << ' ' << q.y() << ' ' << q.z() << ' ' << q.w() << ' ' << (sample.button ? 1 : 0) << '\n';
  }
  return text.str();
}

/// The path of a hand's motion file: HAND.tum, HAND_2.tum, ...
std::string path_of(const std::string& record, std::size_t hand) {
  if (hand == 0) return record;
  std::filesystem::path path(record);
  const std::string name = path.stem().string() + "_" + std::to_string(hand + 1) + path.extension().string();
  return path.replace_filename(name).string();
}

/// Runs the trials and writes the requested files.
void run(const Options& options) {
  const scene::Scene scene = scene::load_scene(options.scene, {}, std::string(config::command_line) + ": --scene");
  if (scene.targets.empty()) validation::refuse(scene.path, "targets", "at least one target");
  for (const std::string& path : {options.out, options.table, options.record}) {  // before hours of trials, not after
    if (!path.empty()) const config::OutputFile can_be_made(path);
  }
  for (const std::string& warning : scene.warnings) std::cerr << "warning: " << warning << "\n";
  std::string csv = csv_header() + "\n";
  std::vector<ToolTrials> all;
  for (const std::string& label : options.tool.empty() ? tool_labels() : std::vector<std::string>{options.tool}) {
    all.push_back({label, {}});
    const simulation::SimulationSettings settings = with_tool(label, options.settings);
    for (int k = 0; k < options.trials; ++k) {
      assembly::OperatorSettings hand = options.hand;
      hand.seed = static_cast<unsigned>(options.seed + k);
      const assembly::Trial trial = assembly::run_trial(scene, settings, hand, options.time_limit);
      all.back().scores.push_back(trial.score);
      csv += std::to_string(hand.seed) + "," + std::to_string(all.size()) + "," + label + ",1,0," +
             assembly::score_csv(trial.score) + "\n";
      if (options.record.empty() || all.size() > 1 || k > 0) continue;
      for (std::size_t h = 0; h < scene.X_WH_start.size(); ++h)
        write_file(path_of(options.record, h), motion_text(trial.motion, h));
    }
  }
  if (!options.table.empty()) write_file(options.table, means_csv(all));
  if (options.out.empty()) {
    std::cout << csv;
  } else {
    write_file(options.out, csv);
  }
}

}  // namespace
}  // namespace spring_workbench::assembly_trials

int main(int argc, char** argv) {
  using namespace spring_workbench;
  return config::run_program(
      "assembly_trials", assembly_trials::help_text(), [&] { return assembly_trials::parse_options(argc, argv); },
      assembly_trials::run);
}
