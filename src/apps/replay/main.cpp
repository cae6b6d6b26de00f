#include <algorithm>
#include <chrono>
#include <iostream>
#include <map>
#include <sstream>
#include <utility>

#include "constants.h"
#include "csv_rows.h"
#include "motion.h"
#include "options.h"
#include "spring_workbench/config/command_line.h"
#include "spring_workbench/config/output_file.h"
#include "spring_workbench/hand_input/input_filter.h"
#include "spring_workbench/instruments/reading_average.h"
#include "spring_workbench/motion_files/open_motion.h"
#include "spring_workbench/scene/scene.h"
#include "spring_workbench/validation/number_rule.h"
#include "summary.h"

namespace spring_workbench::replay {
namespace {

std::map<std::size_t, Motion> load_motions(const Options& options) {
  if (!options.bag.empty()) {
    return read_bag(options.bag, options.parent, options.child, options.settings.clutch_button);
  }
  std::map<std::size_t, Motion> motions;
  for (const std::string& path : options.motions) {
    motions.emplace(motions.size(), read_motion(*motion_files::open_motion(path)));
  }
  return motions;
}

/// Pose of the object that the probe touches.
RigidTransform touched_pose(const simulation::Simulation& simulation, const tools::ToolState& tool) {
  for (const bodies::BodyState& object : simulation.objects()) {
    if (object.name == tool.touched) return object.X_WO;
  }
  return RigidTransform::Identity();
}

/// Rows of RUN.fork.csv, one for each hand that is the first, is present, or has one of `motions`.
class ForkRows {
 public:
  std::string at(double t, const simulation::Simulation& simulation, const std::map<std::size_t, Motion>& motions) {
    std::string rows;
    averages_.resize(simulation.hands());
    for (std::size_t hand = 0; hand < averages_.size(); ++hand) {
      tools::ToolState tool = simulation.tool(hand);
      averages_[hand].add(simulation.world_time(), tool, touched_pose(simulation, tool));
      if (hand == 0 || tool.present || motions.count(hand) > 0) rows += fork_row(t, tool, hand);
    }
    return rows;
  }

 private:
  std::vector<instruments::ReadingAverage> averages_;
};

const std::string scene_option = std::string(config::command_line) + ": --scene";

scene::Scene load_scene(const std::string& path, const std::string& name) {
  scene::Scene scene = scene::load_scene(path, {}, name);
  for (const std::string& warning : scene.warnings) std::cerr << "warning: " << warning << "\n";
  return scene;
}

void push_motion(const Motion& of_hand, std::size_t hand, bool with_grasp, hand_input::InputFilter& filter) {
  for (const motion::StylusSample& sample : of_hand.samples) {
    filter.push_stylus(sample, hand, sample.quaternion_norm);
  }
  for (const ButtonEvent& event : of_hand.next_tool) {
    if (event.pressed) filter.push_edge(event.t, motion::ButtonEdge::next_tool, hand);
  }
  for (const ButtonEvent& event : of_hand.clutch) {
    filter.push_edge(event.t, event.pressed ? motion::ButtonEdge::clutch_on : motion::ButtonEdge::clutch_off, hand);
  }
  if (!with_grasp) return;
  for (const ButtonEvent& event : of_hand.buttons) filter.push_button(event.t, event.pressed, hand);
}

/// Replays a live run; writes rows for each committed time and after each change.
Summary run_journal(const Options& options, const std::vector<live::Entry>& journal) {
  config::OutputFile objects(options.out);
  config::OutputFile fork(fork_path(options.out));
  objects.write(object_header());
  fork.write(fork_header());
  ForkRows fork_rows;
  Summary summary;
  bool first = true;
  const scene::Scene given = load_scene(options.scene, scene_option);  // it replaces the first one
  const auto load = [&](const std::string& scene) {
    return std::exchange(first, false) ? given : load_scene(scene, "scene");
  };
  live::Replayer replayer(load, options.settings);
  const auto started = std::chrono::steady_clock::now();
  for (const live::Entry& entry : journal) {
    const auto at_stop = [&](simulation::Simulation& simulation, const simulation::AdvanceReport& report) {
      summary.advance.add(report);
      summary.add_state(simulation);
      ++summary.outputs;
      objects.write(object_rows(simulation.time(), simulation));
      fork.write(fork_rows.at(simulation.time(), simulation, {}));
    };
    try {
      replayer.play(entry, at_stop);
    } catch (const validation::InputError& error) {
      throw validation::InputError(options.bag + ": " + error.what());
    }
    const auto* accepted = std::get_if<hand_input::AcceptedInput>(&entry.what);
    if (accepted != nullptr && accepted->kind == hand_input::AcceptedInput::Kind::pose) ++summary.samples;
  }
  summary.wall_time = std::chrono::duration<double>(std::chrono::steady_clock::now() - started).count();
  if (replayer.simulation() == nullptr) validation::refuse(options.bag, "~changes", "at least one message");
  summary.changes = replayer.changes();
  for (const std::string& mismatch : summary.changes.mismatches) {
    std::cerr << "warning: replaying a change gave a different state: " << mismatch << "; the recorded state is used\n";
  }
  summary.state_hash = replayer.simulation()->state_hash();
  fork.commit();
  objects.commit();
  return summary;
}

/// Refuses a run to `end` [s] with more output times than a user can want, e.g. where times are in another unit.
void check_length(const Options& options, const std::map<std::size_t, Motion>& motions, double end) {
  const double longest = most_outputs / options.rate;
  if (end <= longest) return;
  std::string file = options.bag;
  for (const auto& [hand, motion] : motions) {
    const bool is_long = std::any_of(motion.samples.begin(), motion.samples.end(),
                                     [&](const motion::StylusSample& sample) { return sample.t > longest; });
    if (is_long && file.empty()) file = options.motions[hand];
  }
  using validation::number_text;
  validation::refuse(file, "time of the last sample", number_text(end),
                     "at most " + number_text(longest) + " s after the first (" + number_text(most_outputs) +
                         " output times at rate = " + number_text(options.rate) + " Hz)");
}

/// Loads the scene, runs the simulation with the recorded hands and writes both files; if it throws, it leaves no
/// files.
Summary run(const Options& options) {
  if (!options.bag.empty() && !options.hand_only) {
    const std::vector<live::Entry> journal = read_journal(options.bag);
    if (!journal.empty()) {
      check_beside_journal(options);
      return run_journal(options, journal);
    }
  }
  const std::map<std::size_t, Motion> motions = load_motions(options);
  simulation::SimulationSettings settings = options.settings;
  settings.styluses = std::max(settings.styluses, static_cast<int>(motions.rbegin()->first) + 1);
  simulation::Simulation simulation(load_scene(options.scene, scene_option), settings);
  config::OutputFile objects(options.out);
  config::OutputFile fork(fork_path(options.out));
  objects.write(object_header());
  fork.write(fork_header());
  ForkRows fork_rows;

  Summary summary;
  hand_input::InputFilter filter(simulation, options.input);
  for (const auto& [hand, motion] : motions) {
    push_motion(motion, hand, settings.grasp.object.empty(), filter);
    summary.samples += motion.samples.size();
  }
  const double end = simulation.newest_sample_time() + time_tolerance;
  check_length(options, motions, end);
  const auto started = std::chrono::steady_clock::now();
  for (double t = 0.0; t <= end; t = ++summary.outputs / options.rate) {
    summary.advance.add(filter.advance_to(t));
    summary.add_state(simulation);
    objects.write(object_rows(t, simulation));
    fork.write(fork_rows.at(t, simulation, motions));
  }
  summary.wall_time = std::chrono::duration<double>(std::chrono::steady_clock::now() - started).count();
  for (const auto& [hand, motion] : motions) {
    summary.add(filter.gate_counts(hand));
    summary.add(filter.reacquisition_counts(hand));
    const std::string complaint = complaint_about_gaps(filter.gate_counts(hand), settings.dropout_after);
    if (!complaint.empty()) std::cerr << "warning: hand " << hand + 1 << ": " << complaint << "\n";
  }
  summary.state_hash = simulation.state_hash();
  fork.commit();
  objects.commit();
  return summary;
}

}  // namespace
}  // namespace spring_workbench::replay

int main(int argc, char** argv) {
  using namespace spring_workbench;
  return config::run_program(
      "replay", replay::help_text(), [&] { return replay::parse_options(argc, argv); },
      [](const replay::Options& options) {
        const replay::Summary summary = replay::run(options);
        for (const std::string& warning : summary.warnings()) std::cerr << "warning: " << warning << "\n";
        std::cout << summary.json() << std::endl;
      });
}
