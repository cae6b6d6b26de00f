#include "benchmark/contact/product_map.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <set>
#include <sstream>

#include "benchmark/contact/bodies.h"

namespace spring_workbench::benchmark {
namespace {

constexpr double edge = 0.1, before = 0.005;           // m; the gap at the start
constexpr double phase = 0.1, rest = 0.2, way = 0.02;  // s, s, m
constexpr double farthest = 0.5;                       // m
constexpr double max_times_real = 3.0;                 // of processor time
constexpr std::array<int, 5> values{12, 13, 4, 4, 4};  // stiffness, ratio, step, damping, scene
constexpr std::array<double, 4> steps{0.05, 0.02, 0.005, 0.001}, dampings{0.0, 0.1, 1.0, 10.0};

using Indices = std::array<int, 5>;

/// The pairs of values of a cell, encoded as numbers.
std::vector<int> pairs_of(const Indices& cell) {
  std::vector<int> pairs;
  for (std::size_t a = 0; a < cell.size(); ++a) {
    for (std::size_t b = 0; b < a; ++b) {
      pairs.push_back(static_cast<int>(10000 * (5 * a + b)) + 100 * cell[a] + cell[b]);
    }
  }
  return pairs;
}

double wide(int i) { return std::pow(10.0, i); }

scene::Body cube(const std::string& name, double mass, const Vector3d& p) {
  return box(name, Vector3d::Constant(edge), mass, p);
}

scene::Body wall(double x) { return standing("wall", geometry::Box{{0.02, 1.0, 1.0}}, at({x + 0.01, 0.0, 0.5}), 0.5); }

}  // namespace

const std::vector<std::string>& map_scenes() {
  static const std::vector<std::string> all{"wall", "free neighbour", "squeezed", "on a stack"};
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
                     dampings[static_cast<std::size_t>(best[3])], best[4]});
  }
  return cells;
}

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
  bodies.insert(bodies.begin(), cube("held", cell.mass_ratio, p_held));
  ContactTrial trial;
  trial.trial = "map";
  std::ostringstream name;
  name << map_scenes().at(static_cast<std::size_t>(cell.scene)) << "; " << cell.stiffness << " N/m; ratio "
       << cell.mass_ratio << "; damping " << cell.damping;
  trial.name = name.str();
  trial.scene = scene_with("map", scene::ContactMode::dynamic, std::move(bodies));
  trial.settings = settings_with(cell.stiffness, 0.01 * cell.stiffness, cell.step, "held");
  trial.settings.fork.damping_ratio = {cell.damping, cell.damping, cell.damping};
  const double length = trial.settings.fork.length;
  trial.X_WH = [=](double t) {
    return hand_above(p_held + minimum_jerk(t / phase) * press + minimum_jerk(t / phase - 1.0) * shift, length);
  };
  trial.rests_from = 2.0 * phase;
  trial.duration = 2.0 * phase + rest;
  trial.max_seconds = 4.0 * max_times_real * trial.duration;
  return trial;
}

void run_map(int count, int first, const TakeRow& take) {
  const std::vector<MapCell> cells = map_cells(first + count);
  std::vector<TrialSum> sums(map_scenes().size());
  std::vector<std::array<int, 3>> counts(
      sums.size());  // cells that pass, that are slower than real time, that are not bounded
  for (std::size_t i = static_cast<std::size_t>(first); i < cells.size(); ++i) {
    const MapCell& cell = cells[i];
    TrialRun run(map_trial(cell));
    double furthest = 0.0;
    for (bool more = true; more;) {
      more = run.advance();
      for (std::size_t k = 0; k < run.start().size(); ++k) {
        furthest = std::max(
            furthest, (run.simulation().objects()[k].X_WO.translation() - run.start()[k].X_WO.translation()).norm());
      }
    }
    const Measured m = run.measured();
    const double times_real = m.cpu_mean / 0.02;
    const TrialRow row =
        run.row({depth_bar(m), blocked_bar(m), unsolved_bar(m), rejected_bar(m),
                 at_most("moved", furthest, farthest, "m"), at_most("times real time", times_real, max_times_real)});
    const auto scene = static_cast<std::size_t>(cell.scene);
    take(sums[scene].add(row));
    counts[scene][0] += row.holds() ? 1 : 0;
    counts[scene][1] += times_real > 1.0 ? 1 : 0;
    counts[scene][2] += furthest > farthest ? 1 : 0;
  }
  for (std::size_t i = 0; i < sums.size(); ++i) {
    if (sums[i].count() == 0) continue;
    const double cells_here = sums[i].count();
    take(sums[i].row("cells: " + map_scenes()[i],
                     {at_least("hold", counts[i][0], cells_here), at_most("too far", counts[i][2], 0.0),
                      at_most("above real time", 100.0 * counts[i][1] / cells_here, 1.0, "%")}));
  }
}

}  // namespace spring_workbench::benchmark
