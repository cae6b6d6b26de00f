#pragma once

#include <yaml-cpp/yaml.h>

#include <string>
#include <vector>

#include "spring_workbench/fork_mesh/constants.h"
#include "spring_workbench/hand_input/settings.h"
#include "spring_workbench/simulation/settings.h"

namespace spring_workbench::manipulation {

/// Private parameters of the node `manipulation`: these and every key of `setting_descriptions()` and
/// `input_descriptions()`.
struct ManipulationParameters {
  std::string scene;                     ///< `scene`, required: a URDF's path or package:// URI
  std::vector<std::string> scene_roots;  ///< `scene_roots`: folders, besides packages, that `~load_scene` may read from
  std::string checkpoint_file;           ///< `checkpoint_file`: file in which the state is also stored; empty: none
  double rate = 100.0;                   ///< `rate` [Hz], 1 … 2000: of the display between samples
  int realtime_priority = 0;       ///< `realtime_priority`, 0 … 99: of the loop's thread under SCHED_FIFO; 0: default
  double display_latency = 0.0;    ///< `display_latency` [s], 0 … 0.1: how far the display is ahead of the samples
  double markers_rate = 30.0;      ///< `markers_rate` [Hz], 0.1 … 200: maximum rate of `~markers`
  std::string fork_curve = "rod";  ///< `fork_curve`: one of fork_curve_names(), the curve that `~markers` draws
  double fork_diameter = fork_mesh::default_diameter;  ///< `fork_diameter`, 0.01 … 0.5: diameter of the drawn coil as a
                                                       ///< fraction of the rest length
  double max_age = 1.0;  ///< `max_age` [s], > 0: older samples are rejected; also the limit for a stream's first stamp
  std::string world_frame = "world";  ///< `world_frame`: frame of all that is published
  std::string frame_prefix;           ///< `frame_prefix`: prefix of the frames of tools and objects; may be empty
  std::string workbench_frame =
      "workbench";  ///< `workbench_frame`: placed at the origin of world unless /tf_static says otherwise
  std::string stylus_frame = "stylus";  ///< `stylus_frame`: child frame on /tf that serves as the handle of the tool
  simulation::SimulationSettings simulation;
  hand_input::InputSettings input;  ///< `input`: how the samples of the stylus are gated, filtered and followed
};

/// Reads the map of private parameters. Throws InputError with `where`, key, value and rule.
ManipulationParameters read_manipulation_parameters(const YAML::Node& parameters, const std::string& where);

}  // namespace spring_workbench::manipulation
