#include "run.h"

#include <chrono>
#include <iostream>
#include <limits>
#include <map>

#include "csv_rows.h"
#include "output_file.h"
#include "spring_workbench/hand_input/input_filter.h"
#include "spring_workbench/hand_input/reacquisition.h"
#include "spring_workbench/motion_files/open_motion.h"
#include "spring_workbench/scene/scene.h"

namespace spring_workbench::replay {
namespace {

constexpr double kTimeTolerance = 1e-9;  // [s] an output time this much after the motion's end is still given

std::vector<Motion> load_motions(const Options& options) {
  if (!options.bag.empty()) return read_bag(options.bag, options.parent, options.child);
  std::vector<Motion> motions;
  for (const std::string& path : options.motions) motions.push_back(read_motion(*motion_files::open_motion(path)));
  return motions;
}

/// RUN.csv → RUN.fork.csv
std::string fork_path(const std::string& path) {
  const std::string ending = ".csv";
  const bool has_ending =
      path.size() > ending.size() && path.compare(path.size() - ending.size(), ending.size(), ending) == 0;
  return (has_ending ? path.substr(0, path.size() - ending.size()) : path) + ".fork.csv";
}

simulation::Simulation make_simulation(const Options& options) {
  const scene::Scene scene = scene::load_scene(options.scene);
  for (const std::string& warning : scene.warnings) std::cerr << "warning: " << warning << "\n";
  return simulation::Simulation(scene, options.settings);
}

/// Gives the simulation the samples that the truth layer lets through, as `manipulation` does.
void push_motion(const Motion& motion, std::size_t hand, const Options& options, hand_input::Reengagement& follower,
                 simulation::Simulation& simulation, Summary& summary) {
  constexpr double nothing_simulated = -std::numeric_limits<double>::infinity();
  hand_input::TruthLayer truth(options.truth, options.settings.dropout_after);
  for (const motion::PoseSample& sample : motion.samples) {
    ++summary.samples;
    const hand_input::TrueSample taken = truth.take(sample);
    if (!hand_input::usable(taken.verdict)) continue;
    const bool new_place = taken.verdict == hand_input::Verdict::new_place;
    for (const motion::PoseSample& s : follower.follow(taken.sample, new_place, nothing_simulated)) {
      simulation.push_stylus(s, hand);
    }
  }
  summary.add(truth.counts());
  for (const ButtonEvent& event : motion.next_tool) {
    if (event.pressed) simulation.push_next_tool(event.t, hand);
  }
  if (!options.settings.grasp.object.empty()) return;
  for (const ButtonEvent& event : motion.buttons) simulation.push_button(event.t, event.pressed, hand);
}

/// Goes to t; lets go of what a hand holds where it is lost on the way.
void advance(double t, std::vector<hand_input::Reengagement>& hands, simulation::Simulation& simulation,
             Summary& summary) {
  std::multimap<double, std::size_t> releases;
  for (std::size_t hand = 0; hand < hands.size(); ++hand) {
    while (const auto release = hands[hand].take_release(t)) releases.emplace(*release, hand);
  }
  for (const auto& [at, hand] : releases) {
    summary.add(simulation.advance(at));
    simulation.release(hand);
  }
  summary.add(simulation.advance(t));
}

}  // namespace

Summary run(const Options& options) {
  const std::vector<Motion> motions = load_motions(options);
  simulation::Simulation simulation = make_simulation(options);
  OutputFile objects(options.out);
  OutputFile fork(fork_path(options.out));
  objects.write(object_header());
  fork.write(fork_header());

  Summary summary;
  std::vector<hand_input::Reengagement> hands(motions.size(), hand_input::Reengagement(options.truth));
  for (std::size_t hand = 0; hand < hands.size(); ++hand) {
    push_motion(motions[hand], hand, options, hands[hand], simulation, summary);
  }
  const double end = simulation.newest_sample() + kTimeTolerance;
  const auto started = std::chrono::steady_clock::now();
  for (double t = 0.0; t <= end; t = ++summary.outputs / options.rate) {
    advance(t, hands, simulation, summary);
    summary.add_contacts(simulation.contacts());
    objects.write(object_rows(t, simulation));
    for (std::size_t hand = 0; hand < hands.size(); ++hand) fork.write(fork_row(t, simulation, hand));
  }
  summary.wall_time = std::chrono::duration<double>(std::chrono::steady_clock::now() - started).count();
  for (const hand_input::Reengagement& hand : hands) summary.add(hand.counts());
  fork.commit();
  objects.commit();
  return summary;
}

}  // namespace spring_workbench::replay
