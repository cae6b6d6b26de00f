#pragma once

#include "benchmark/contact/trial_run.h"

namespace spring_workbench::benchmark {

/// A combination of the factors that make contact difficult, in contact mode `dynamic`.
struct MapCell {
  double stiffness = 1e3;  ///< of stretch and bend [N/m], 1e-2 … 1e9 by decades; torsion: a hundredth of it [N·m/rad]
  double mass_ratio = 1.0;  ///< mass of the held box relative to its neighbours of 1 kg, 1e-6 … 1e6 by decades
  double step = 0.02;       ///< 1/20, 1/50, 1/200, 1/1000 [s]
  double damping = 1.0;     ///< ratio: 0, 0.1, 1, 10
  int scene = 0;            ///< index in `map_scenes()`
};
/// Obstacles that the held box is pressed against: a fixed wall, a loose box, a loose box in front of a wall, a stack
/// of three.
const std::vector<std::string>& map_scenes();

/// The first `count` cells of a seeded sequence, of which the first 200 contain every pair of values.
std::vector<MapCell> map_cells(int count);

/// The hand presses the held box by 20 mm, shifts it sideways by 20 mm in the next 0.1 s, and rests for 0.2 s.
ContactTrial map_trial(const MapCell& cell);

/// Writes a row for each of the cells first … first + count − 1, and a summary for each scene.
void run_map(int count, int first, const TakeRow& take);

}  // namespace spring_workbench::benchmark
