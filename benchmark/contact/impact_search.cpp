#include "benchmark/contact/impact_search.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include "benchmark/contact/processor_time.h"
#include "spring_workbench/contact/contact_engines.h"
#include "spring_workbench/math/so3.h"

namespace spring_workbench::benchmark {
namespace {

constexpr double tolerance = 1e-6, resolution = 2e-4;  // m, as in contact mode `stop`
constexpr double path_length = 0.04;                   // m
const Vector3d size(0.1, 0.06, 0.04);                  // m
constexpr int rounds = 2;                              // of timing

Vector3d corner(int i) {
  return 0.5 * size.cwiseProduct(Vector3d((i & 1) ? 1 : -1, (i & 2) ? 1 : -1, (i & 4) ? 1 : -1));
}

geometry::MeshPtr box_mesh(const Vector3d& box) {
  auto mesh = std::make_shared<geometry::TriangleMesh>();
  for (int i = 0; i < 8; ++i) {
    mesh->vertices.push_back(0.5 * box.cwiseProduct(Vector3d((i & 1) ? 1 : -1, (i & 2) ? 1 : -1, (i & 4) ? 1 : -1)));
  }
  for (const Eigen::Vector4i& f :
       {Eigen::Vector4i(0, 2, 3, 1), Eigen::Vector4i(4, 5, 7, 6), Eigen::Vector4i(0, 1, 5, 4),
        Eigen::Vector4i(2, 6, 7, 3), Eigen::Vector4i(0, 4, 6, 2), Eigen::Vector4i(1, 3, 7, 5)}) {
    mesh->triangles.emplace_back(f[0], f[1], f[2]);
    mesh->triangles.emplace_back(f[0], f[2], f[3]);
  }
  return mesh;
}

scene::Body body_of(const std::string& name, const geometry::Geometry& geometry, const Vector3d& p_WO, bool movable) {
  scene::Body body;
  body.name = name;
  body.movable = movable;
  body.X_WO.translation() = p_WO;
  body.mass_properties.mass = movable ? 1.0 : 0.0;
  body.collision.push_back({geometry});
  return body;
}

struct Pair {
  std::string name;
  std::unique_ptr<collision::CollisionWorld> world;
};

/// The same box and the same plane z = 0 as three kinds of shapes.
std::vector<Pair> pairs() {
  const Vector3d floor(2.0, 2.0, 0.2), below(0.0, 0.0, -0.1), start(0.0, 0.0, 1.0);
  const auto world_of = [](std::vector<scene::Body> bodies, double bench) {
    scene::Scene scene;
    scene.name = scene.path = "impact";
    scene.contact = scene::ContactMode::stop;
    scene.bench_height = bench;
    scene.bodies = std::move(bodies);
    return contact::open_collision_world(scene);
  };
  std::vector<Pair> all;
  all.push_back({"box on bench", world_of({body_of("box", geometry::Box{size}, start, true)}, 0.0)});
  all.push_back({"box on box", world_of({body_of("box", geometry::Box{size}, start, true),
                                         body_of("floor", geometry::Box{floor}, below, false)},
                                        -9.0)});
  all.push_back(
      {"mesh on mesh",
       world_of({body_of("box", box_mesh(size), start, true), body_of("floor", box_mesh(floor), below, false)}, -9.0)});
  return all;
}

struct Move {
  RigidTransform X0, X1;
  double exact;  ///< exact fraction of the motion
};

RigidTransform at(const Move& move, double u) {
  RigidTransform X = move.X0;
  X.linear() = move.X0.linear() * math::exp_so3(u * math::log_so3(move.X0.linear().transpose() * move.X1.linear()));
  X.translation() += u * (move.X1.translation() - move.X0.translation());
  return X;
}

double depth(const RigidTransform& X) { return 0.5 * X.linear().row(2).cwiseAbs().dot(size) - X.translation().z(); }

std::vector<Move> make_moves(int count) {
  std::mt19937 random(8);
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  const auto any = [&] { return Vector3d(unit(random), unit(random), unit(random)); };
  std::vector<Move> moves;
  while (static_cast<int>(moves.size()) < count) {
    Move move{RigidTransform::Identity(), RigidTransform::Identity(), 0.0};
    move.X0.linear() = math::exp_so3(M_PI * any());
    move.X1.linear() = move.X0.linear() * math::exp_so3(0.5 * any());
    move.X0.translation() = Vector3d(0.0, 0.0, 0.5 * size.norm() + 0.01 * unit(random));
    move.X1.translation() = move.X0.translation() + path_length * (any() - 2.0 * Vector3d::UnitZ()).normalized();
    // First moment of contact, by small steps and bisection.
    constexpr int steps = 4000;
    int i = 0;
    while (i <= steps && depth(at(move, static_cast<double>(i) / steps)) <= tolerance) ++i;
    if (i == 0 || i > steps) continue;
    double from = static_cast<double>(i - 1) / steps, to = static_cast<double>(i) / steps;
    for (int k = 0; k < 50; ++k) {
      const double middle = 0.5 * (from + to);
      (depth(at(move, middle)) <= tolerance ? from : to) = middle;
    }
    move.exact = from;
    moves.push_back(move);
  }
  return moves;
}

double largest_distance(const RigidTransform& A, const RigidTransform& B) {
  double largest = 0.0;
  for (int i = 0; i < 8; ++i) largest = std::max(largest, (A * corner(i) - B * corner(i)).norm());
  return largest;
}

ImpactRow measure(const Pair& pair, const std::vector<Move>& moves, int levels) {
  ImpactRow row{pair.name, levels};
  for (const Move& move : moves) {
    const collision::SweepResult found = pair.world->sweep(0, move.X0, move.X1, tolerance, resolution, levels);
    const RigidTransform X = at(move, found.free_fraction);
    const double error = largest_distance(X, at(move, move.exact));
    row.mean_error += error / static_cast<double>(moves.size());
    row.largest_error = std::max(row.largest_error, error);
    row.through += depth(X) > tolerance + 1e-9 ? 1 : 0;
  }
  double least = std::numeric_limits<double>::infinity();
  for (int round = 0; round < rounds; ++round) {
    const double begin = processor_time();
    for (const Move& move : moves) pair.world->sweep(0, move.X0, move.X1, tolerance, resolution, levels);
    least = std::min(least, processor_time() - begin);
  }
  row.cpu_us = 1e6 * least / static_cast<double>(moves.size());
  return row;
}

}  // namespace

std::vector<ImpactRow> measure_impact_search(int moves) {
  const std::vector<Move> all = make_moves(moves);
  std::vector<ImpactRow> rows;
  for (const Pair& pair : pairs()) {
    for (const int levels : {2, 4, 6, 8, 10, 12, 14, 16, 0}) rows.push_back(measure(pair, all, levels));
  }
  return rows;
}

}  // namespace spring_workbench::benchmark
