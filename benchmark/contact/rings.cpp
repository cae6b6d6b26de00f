#include "benchmark/contact/rings.h"

#include <algorithm>
#include <cmath>
#include <random>

#include "benchmark/contact/bodies.h"
#include "spring_workbench/math/so3.h"

namespace spring_workbench::benchmark {
namespace {

constexpr double sample_time = 0.02;                                           // s
constexpr double stress_time = 0.2, swing_time = 2.0;                          // s
constexpr double ring_radius = 0.05, tube_radius = 0.01;                       // m, on the peg
constexpr double peg_radius = 0.005, peg_length = 4.0, between_rings = 0.025;  // m
constexpr double link_radius = 0.02, link_tube = 0.004;                        // m, of the chain
constexpr int links = 10;
constexpr double swing_speed = 2.0;  // m/s

/// Whether the peg, along z of A, passes through the hole of a ring.
bool on_peg(const RigidTransform& X_AR) {
  const Vector3d n = X_AR.linear().col(2);
  if (std::abs(n.z()) < 1e-6) return false;
  const double z = n.dot(X_AR.translation()) / n.z();
  return std::abs(z) < 0.5 * peg_length && (Vector3d(0.0, 0.0, z) - X_AR.translation()).norm() < ring_radius;
}

/// Whether the middle circles of two rings of one size are linked: one passes through the disc of the other once.
bool linked(const RigidTransform& X_AB, double radius) {
  // Height above A's disc: p_z + radius (a cos + b sin); 0 twice or never.
  const double p = X_AB.translation().z(), a = radius * X_AB.linear()(2, 0), b = radius * X_AB.linear()(2, 1),
               most = std::hypot(a, b);
  if (std::abs(p) >= most) return false;
  int inside = 0;
  for (const double side : {-1.0, 1.0}) {
    const double at = std::atan2(b, a) + side * std::acos(-p / most);
    const Vector3d q = X_AB * Vector3d(radius * std::cos(at), radius * std::sin(at), 0.0);
    inside += q.head<2>().norm() < radius ? 1 : 0;
  }
  return inside == 1;
}

}  // namespace

ContactTrial rings_on_peg(unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  RigidTransform X_WP = at(Vector3d(0.0, 0.0, 3.0));
  X_WP.linear() = math::exp_so3(in_ball(M_PI, random));
  const geometry::MeshPtr ring = torus(ring_radius, tube_radius);
  std::vector<scene::Body> bodies;
  for (int i = 0; i < 5; ++i) {
    const double z = i == 0 ? 0.0 : between_rings * (i < 3 ? i : 2 - i);
    bodies.push_back(
        uniform(i == 0 ? "held" : "ring" + std::to_string(i), ring, X_WP * Eigen::Translation3d(0, 0, z), 0.3, 0.3));
  }
  bodies.push_back(uniform("peg", geometry::Cylinder{peg_radius, peg_length}, X_WP, 0.3, 1.0));
  ContactTrial trial;
  trial.trial = "rings";
  trial.name = "seed " + std::to_string(seed);
  trial.scene = scene_with("rings", scene::ContactMode::dynamic, std::move(bodies));
  trial.scene.bench_height = -10.0;
  const double k = 2000.0 * std::pow(10.0, unit(random));
  trial.settings = settings_with(k, 1e-3 * k, 0.02, "held");
  trial.settings.fork.length = 0.05;
  std::vector<RigidTransform> samples{X_WP * Eigen::Translation3d(0.0, 0.0, -trial.settings.fork.length)};
  Vector3d v = Vector3d::Zero(), w = v;
  for (int i = 0; i <= static_cast<int>(std::lround(stress_time / sample_time)); ++i) {
    if (i % 5 == 0) v = in_ball(5.0, random), w = in_ball(50.0, random);
    RigidTransform next = samples.back();
    next.translation() += sample_time * v;
    next.linear() = math::exp_so3(sample_time * w) * next.linear();
    samples.push_back(next);
  }
  trial.X_WH = [samples](double t) { return samples.at(static_cast<std::size_t>(std::lround(t / sample_time))); };
  trial.duration = stress_time;
  return trial;
}

void run_rings(int count, int first, const TakeRow& take) {
  TrialSum sum;
  int lost = 0;
  for (int seed = first; seed < first + count; ++seed) {
    TrialRun run(rings_on_peg(static_cast<unsigned>(seed)));
    bool off = false;
    for (bool more = true; more;) {
      more = run.advance();
      const RigidTransform X_PW = run.pose("peg").inverse();
      for (const bodies::BodyState& o : run.simulation().objects()) {
        off = off || (o.name != "peg" && !on_peg(X_PW * o.X_WO));
      }
    }
    lost += off ? 1 : 0;
    const Measured m = run.measured();
    take(sum.add(
        run.row({at_most("off the peg", off, 0.0), depth_bar(m), blocked_bar(m), unsolved_bar(m), rejected_bar(m)})));
  }
  take(sum.row("random motions", {at_most("with a ring off the peg", lost, 0.0),
                                  at_most("mean", 1e3 * sum.measured().cpu_mean, 20.0, "ms")}));
}

ContactTrial swung_chain(unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  const double heading = 2.0 * M_PI * unit(random), omega = 5.0 + 10.0 * unit(random);
  const Vector3d along(std::cos(heading), std::sin(heading), 0.0);
  const double pitch = 2.0 * (link_radius - link_tube) - 5e-4;
  const Vector3d top(0.0, 0.0, 1.0);
  const geometry::MeshPtr link = torus(link_radius, link_tube);
  std::vector<scene::Body> bodies;
  for (int i = 0; i < links; ++i) {
    RigidTransform X_WO = at(top - pitch * i * Vector3d::UnitZ());
    X_WO.linear() =
        (Eigen::AngleAxisd(0.5 * M_PI * (i % 2), Vector3d::UnitZ()) * Eigen::AngleAxisd(0.5 * M_PI, Vector3d::UnitX()))
            .toRotationMatrix();
    bodies.push_back(uniform(i == 0 ? "held" : "link" + std::to_string(i), link, X_WO, 0.3, 0.05));
  }
  ContactTrial trial;
  trial.trial = "chain";
  trial.name = "seed " + std::to_string(seed);
  trial.scene = scene_with("chain", scene::ContactMode::dynamic, std::move(bodies));
  trial.scene.bench_height = -10.0;
  trial.settings = settings_with(2e4, 20.0, 0.02, "held");
  const double length = trial.settings.fork.length;
  trial.X_WH = [=](double t) {
    const double gently = std::min(1.0, t / 0.2);  // starts from rest
    return hand_above(top + gently * gently * swing_speed / omega * std::sin(omega * t) * along, length);
  };
  trial.duration = swing_time;
  return trial;
}

void run_chains(int count, int first, const TakeRow& take) {
  TrialSum sum;
  int lost = 0;
  for (int seed = first; seed < first + count; ++seed) {
    TrialRun run(swung_chain(static_cast<unsigned>(seed)));
    bool apart = false;
    for (bool more = true; more;) {
      more = run.advance();
      const std::vector<RigidTransform> X_WO = run.poses();
      for (std::size_t i = 1; i < X_WO.size(); ++i) {
        apart = apart || !linked(X_WO[i - 1].inverse() * X_WO[i], link_radius);
      }
    }
    lost += apart ? 1 : 0;
    const Measured m = run.measured();
    take(sum.add(
        run.row({at_most("unlinked", apart, 0.0), depth_bar(m), blocked_bar(m), unsolved_bar(m), rejected_bar(m)})));
  }
  take(sum.row("swings", {at_most("unlinked", lost, 0.0), at_most("mean", 1e3 * sum.measured().cpu_mean, 40.0, "ms")}));
}

}  // namespace spring_workbench::benchmark
