#include "benchmark/contact/product_map.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <set>
#include <sstream>

#include "benchmark/contact/bodies.h"
#include "benchmark/contact/trial_run.h"
#include "spring_workbench/validation/input_error.h"

namespace spring_workbench::benchmark {
namespace {

constexpr double edge = 0.1, before = 0.005;           // m; the gap at the start
constexpr double phase = 0.1, rest = 0.2, way = 0.02;  // s, s, m
constexpr double give_up = 12.0;                       // times real time
constexpr int per_unit = 10;                           // cells
// stiffness, ratio, step, damping, scene, friction, shape, mode
constexpr std::array<int, 8> values{12, 13, 4, 4, 4, 3, 3, 2};
constexpr std::array<double, 4> steps{0.05, 0.02, 0.005, 0.001}, dampings{0.0, 0.1, 1.0, 10.0};
constexpr std::array<double, 3> frictions{0.0, 0.3, 1.0};
constexpr std::array<scene::ContactMode, 2> modes{scene::ContactMode::dynamic, scene::ContactMode::stop};

using Indices = std::array<int, 8>;

/// The pairs of values of a cell, encoded as numbers.
std::vector<int> pairs_of(const Indices& cell) {
  std::vector<int> pairs;
  for (std::size_t a = 0; a < cell.size(); ++a) {
    for (std::size_t b = 0; b < a; ++b) {
      pairs.push_back(static_cast<int>(10000 * (cell.size() * a + b)) + 100 * cell[a] + cell[b]);
    }
  }
  return pairs;
}

double wide(int i) { return std::pow(10.0, i); }

scene::Body cube(const std::string& name, double mass, const Vector3d& p) {
  return box(name, Vector3d::Constant(edge), mass, p);
}

/// The held object: as wide and high as a cube.
scene::Body held(const MapCell& cell, const Vector3d& p) {
  const std::array<geometry::Geometry, 3> shapes{geometry::Box{Vector3d::Constant(edge)}, geometry::Sphere{0.5 * edge},
                                                 geometry::Cylinder{0.5 * edge, edge}};
  return uniform("held", shapes.at(static_cast<std::size_t>(cell.shape)), at(p), cell.friction, cell.mass_ratio);
}

scene::Body wall(double x) { return standing("wall", geometry::Box{{0.02, 1.0, 1.0}}, at({x + 0.01, 0.0, 0.5}), 0.5); }

ContactTrial map_trial(const MapCell& cell) {
  Vector3d p_held(0.0, 0.0, 0.5 * edge), press = way * Vector3d::UnitX(), shift = way * Vector3d::UnitY();
  std::vector<scene::Body> bodies;
  const double next_to = edge + before;
  switch (cell.scene) {
    case 0:
      bodies = {wall(0.5 * edge + before)};
      break;
    case 1:
      bodies = {cube("neighbour", 1.0, {next_to, 0.0, 0.5 * edge})};
      break;
    case 2:
      bodies = {cube("neighbour", 1.0, {next_to, 0.0, 0.5 * edge}), wall(next_to + 0.5 * edge)};
      break;
    default:
      for (int i = 0; i < 3; ++i) bodies.push_back(cube("box" + std::to_string(i), 1.0, {0.0, 0.0, (i + 0.5) * edge}));
      p_held.z() += 3.0 * edge + before;
      press = -way * Vector3d::UnitZ();
      shift = 0.25 * way * Vector3d::UnitX();
  }
  bodies.insert(bodies.begin(), held(cell, p_held));
  for (scene::Body& body : bodies) body.material.friction = cell.friction;
  ContactTrial trial;
  trial.scene = scene_with("map", cell.contact, std::move(bodies));
  trial.settings = settings_with(cell.stiffness, 0.01 * cell.stiffness, cell.step, "held");
  trial.settings.fork.damping_ratio = {cell.damping, cell.damping, cell.damping};
  const double length = trial.settings.fork.length;
  trial.X_WH = [=](double t) {
    return hand_above(p_held + minimum_jerk(t / phase) * press + minimum_jerk(t / phase - 1.0) * shift, length);
  };
  trial.rests_from = 2.0 * phase;
  trial.duration = 2.0 * phase + rest;
  trial.max_seconds = give_up * trial.duration;
  return trial;
}

int cell_count(bool quick) { return quick ? per_unit : 200; }

}  // namespace

const std::vector<std::string>& map_scenes() {
  static const std::vector<std::string> all{"wall", "free neighbour", "squeezed", "on a stack"};
  return all;
}

const std::vector<std::string>& map_shapes() {
  static const std::vector<std::string> all{"box", "sphere", "cylinder"};
  return all;
}

std::vector<MapCell> map_cells(int count) {
  std::mt19937 random(22);
  std::set<int> met;
  std::vector<MapCell> cells;
  while (static_cast<int>(cells.size()) < count) {
    Indices best{};
    int most = -1;
    for (int candidate = 0; candidate < 100;
         ++candidate) {  // of a hundred candidates, choose the one with the most new pairs
      Indices cell{};
      for (std::size_t k = 0; k < cell.size(); ++k) {
        cell[k] = static_cast<int>(random() % static_cast<unsigned>(values[k]));
      }
      int fresh = 0;
      for (const int pair : pairs_of(cell)) fresh += met.count(pair) == 0 ? 1 : 0;
      if (fresh > most) most = fresh, best = cell;
    }
    for (const int pair : pairs_of(best)) met.insert(pair);
    cells.push_back({wide(best[0] - 2), wide(best[1] - 6), steps[static_cast<std::size_t>(best[2])],
                     dampings[static_cast<std::size_t>(best[3])], best[4], frictions[static_cast<std::size_t>(best[5])],
                     best[6], modes[static_cast<std::size_t>(best[7])]});
  }
  return cells;
}

MapRow run(const MapCell& cell) {
  TrialRun run(map_trial(cell));
  MapRow row;
  row.obstacle = map_scenes().at(static_cast<std::size_t>(cell.scene));
  row.cell = cell;
  for (bool more = true; more;) {
    more = run.advance();
    for (std::size_t k = 0; k < run.start().size(); ++k) {
      const Vector3d way = run.simulation().objects()[k].X_WO.translation() - run.start()[k].X_WO.translation();
      row.moved = std::max(row.moved, way.norm());
    }
  }
  const Measured m = run.measured();
  row.finite = m.finite;
  row.to_the_end = m.to_the_end;
  row.simulated = m.simulated;
  row.depth = m.deepest.depth;
  row.steps_blocked = m.steps_blocked;
  row.steps_unsolved = m.steps_unsolved;
  row.steps_rejected = m.steps_rejected;
  row.times_real = m.cpu_mean / 0.02;
  return row;
}

std::size_t map_unit_count(bool quick) { return static_cast<std::size_t>(cell_count(quick) / per_unit); }

std::vector<MapRow> contact_map(bool quick, Units& units) {
  units.begin("map of contact");
  const std::vector<MapCell> cells = map_cells(cell_count(quick));
  std::vector<MapRow> all;
  for (std::size_t unit = 0; unit < map_unit_count(quick); ++unit) {
    const auto rows = units.rows<MapRow>(unit, "map of contact, part " + std::to_string(unit + 1), [&] {
      std::vector<MapRow> here;
      try {
        for (std::size_t i = per_unit * unit; i < per_unit * (unit + 1); ++i) here.push_back(run(cells[i]));
      } catch (const validation::InputError&) {  // this mode was not built
        here.clear();
      }
      return here;
    });
    all.insert(all.end(), rows.begin(), rows.end());
  }
  return all;
}

std::string contact_map_csv(const std::vector<MapRow>& rows) {
  std::ostringstream out;
  out << "contact,obstacle,shape,friction,stiffness,mass_ratio,step,damping,finite,simulated,depth_mm,moved,steps_"
         "blocked,steps_unsolved,"
         "steps_rejected,times_real_time,passed\n";
  for (const MapRow& row : rows) {
    out << name_of(row.cell.contact) << ',' << row.obstacle << ','
        << map_shapes().at(static_cast<std::size_t>(row.cell.shape)) << ',' << row.cell.friction << ','
        << row.cell.stiffness << ',' << row.cell.mass_ratio << ',' << row.cell.step << ',' << row.cell.damping << ','
        << row.finite << ',' << row.simulated << ',' << 1e3 * row.depth << ',' << row.moved << ',' << row.steps_blocked
        << ',' << row.steps_unsolved << ',' << row.steps_rejected << ',' << row.times_real << ',' << row.holds()
        << '\n';
  }
  return out.str();
}

}  // namespace spring_workbench::benchmark
