#pragma once

#include <string>
#include <vector>

#include "benchmark/units.h"
#include "spring_workbench/scene/scene.h"

namespace spring_workbench::benchmark {

/// A combination of the factors that make contact difficult.
struct MapCell {
  double stiffness = 1e3;  ///< of stretch and bend [N/m], 1e-2 … 1e9 by decades; torsion: a hundredth of it [N·m/rad]
  double mass_ratio = 1.0;  ///< mass of the held box relative to its neighbours of 1 kg, 1e-6 … 1e6 by decades
  double step = 0.02;       ///< 1/20, 1/50, 1/200, 1/1000 [s]
  double damping = 1.0;     ///< ratio: 0, 0.1, 1, 10
  int scene = 0;            ///< index in `map_scenes()`
  double friction = 0.5;    ///< of all bodies: 0, 0.3, 1
  int shape = 0;            ///< of the held object, index in `map_shapes()`
  scene::ContactMode contact = scene::ContactMode::dynamic;  ///< dynamic, or stop: no other body moves
};
/// Obstacles that the held object is pressed against: a fixed wall, a loose box, a loose box in front of a wall, a
/// stack of three.
const std::vector<std::string>& map_scenes();
/// Shapes of the held object: a box, a sphere, and a cylinder whose axis is vertical.
const std::vector<std::string>& map_shapes();

/// The first `count` cells of a seeded sequence, of which the first 200 contain every pair of values.
std::vector<MapCell> map_cells(int count);

/// Result of a cell.
struct MapRow {
  std::string obstacle;  ///< of `map_scenes()`
  MapCell cell;
  bool finite = true;
  double simulated = 0.0;  ///< less than the whole 0.4 s if the run was given up [s]
  double depth = 0.0;      ///< largest, of any pair of bodies [m]
  double moved = 0.0;      ///< farthest way of an object from where it began [m]
  int steps_blocked = 0, steps_unsolved = 0, steps_rejected = 0;
  double times_real = 0.0;  ///< processor time over simulated time
  bool to_the_end = false;
  bool holds() const {
    return finite && to_the_end && depth <= 1e-4 && moved <= 0.5 && times_real <= 3.0 &&
           steps_blocked + steps_unsolved + steps_rejected == 0;
  }
};
template <typename Fields>
void each_field(MapRow& r, Fields& fields) {
  MapCell& c = r.cell;
  fields(r.obstacle, c.stiffness, c.mass_ratio, c.step, c.damping, c.scene, r.finite, r.simulated, r.depth, r.moved,
         r.steps_blocked, r.steps_unsolved, r.steps_rejected, r.times_real, r.to_the_end, c.friction, c.shape,
         c.contact);
}

/// The hand presses the held object by 20 mm, shifts it sideways by 20 mm in the next 0.1 s, and rests for 0.2 s. A run
/// is given up after four times the processor time with which it would hold.
MapRow run(const MapCell& cell);

/// Runs the first 200 cells, or a few of them if `quick`. No rows if the mode was not built.
std::vector<MapRow> contact_map(bool quick, Units& units);
/// Number of units of work.
std::size_t map_unit_count(bool quick);

std::string contact_map_csv(const std::vector<MapRow>& rows);

}  // namespace spring_workbench::benchmark
