#include "benchmark/contact/stress_motions.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <stdexcept>

#include "benchmark/contact/bodies.h"
#include "benchmark/contact/processor_time.h"
#include "spring_workbench/math/so3.h"
#include "spring_workbench/simulation/simulation.h"

namespace spring_workbench::benchmark {
namespace {

constexpr double sample_time = 0.02, duration = 0.2;
constexpr double max_speed_seen = 5.0, max_turning = 50.0;
constexpr double hand_reach = 0.35;                       // m from the centre, where the hand reverses
const Vector3d middle(0.0, 0.0, 1.0);                     // of the scene, m
const Vector3d rod_size(0.3, 0.01, 0.01);                 // m
constexpr double room = 0.25, wall = 0.001;               // m: from the middle to a wall's middle, its thickness
constexpr double ring_radius = 0.05, tube_radius = 0.01;  // m
constexpr double friction = 0.3;
constexpr double pin_radius = 0.005, pin_length = 4.0;  // m, of the rod through the ring

RigidTransform at_middle(const Matrix3d& R = Matrix3d::Identity()) {
  RigidTransform X = RigidTransform::Identity();
  X.linear() = R;
  X.translation() = middle;
  return X;
}

/// Distance of a segment from the z axis.
double distance_from_axis(const Vector3d& a, const Vector3d& b) {
  const Eigen::Vector2d p = a.head<2>(), d = (b - a).head<2>();
  const double s = d.squaredNorm() > 0.0 ? std::clamp(-p.dot(d) / d.squaredNorm(), 0.0, 1.0) : 0.0;
  return (p + s * d).norm();
}

/// Penetration of the pin (along z of A) into the ring at X_AR; the edges of the ring are the points nearest to a line.
double ring_depth(const geometry::TriangleMesh& ring, const RigidTransform& X_AR) {
  double nearest = std::numeric_limits<double>::infinity();
  for (const Eigen::Vector3i& t : ring.triangles) {
    for (int k = 0; k < 3; ++k) {
      const auto corner = [&](int i) { return Vector3d(X_AR * ring.vertices[static_cast<std::size_t>(t[i % 3])]); };
      nearest = std::min(nearest, distance_from_axis(corner(k), corner(k + 1)));
    }
  }
  return pin_radius - nearest;
}

/// Whether the pin passes through the hole of the ring.
bool linked(const RigidTransform& X_AR) {
  const Vector3d n = X_AR.linear().col(2);
  if (std::abs(n.z()) < 1e-6) return false;
  const double z = n.dot(X_AR.translation()) / n.z();
  return (Vector3d(0.0, 0.0, z) - X_AR.translation()).norm() < ring_radius;
}

struct Setting {
  scene::Scene scene;
  geometry::MeshPtr ring = torus(ring_radius, tube_radius);
  RigidTransform X_WF = at_middle();  // pose of the room or the pin
};

Setting set_scene(const StressMotion& motion, const Matrix3d& R_scene, const Matrix3d& R_held) {
  Setting s;
  s.scene.name = s.scene.path = name_of(motion.scene);
  s.scene.contact = motion.contact;
  s.X_WF = at_middle(R_scene);
  const double mass = 0.3;
  if (motion.scene == StressScene::rod_in_room) {
    s.scene.bodies.push_back(
        movable("held", geometry::Box{rod_size}, at_middle(R_held), friction, mass, box_inertia(mass, rod_size)));
    for (int axis = 0; axis < 3; ++axis) {
      for (const double side : {-room, room}) {
        Vector3d size = Vector3d::Constant(2.0 * room + 0.1), p = Vector3d::Zero();
        size[axis] = wall;
        p[axis] = side;
        s.scene.bodies.push_back(standing("wall" + std::to_string(s.scene.bodies.size()), geometry::Box{size},
                                          s.X_WF * Eigen::Translation3d(p), friction));
      }
    }
  } else {
    s.scene.bodies.push_back(movable("held", s.ring, s.X_WF, friction, mass, mass * Vector3d(1.5e-3, 1.5e-3, 3e-3)));
    s.scene.bodies.push_back(standing("pin", geometry::Cylinder{pin_radius, pin_length}, s.X_WF, friction));
    s.scene.bench_height = -10.0;
  }
  return s;
}

void look(const StressMotion& motion, const Setting& setting, const RigidTransform& X_WO, StressResult& result) {
  if (!X_WO.matrix().allFinite()) throw std::runtime_error("a pose that is not finite");
  const RigidTransform X_FO = setting.X_WF.inverse() * X_WO;
  double depth = 0.0;
  bool outside = false;
  if (motion.scene == StressScene::rod_in_room) {
    for (int i = 0; i < 8; ++i) {
      const Vector3d sign((i & 1) ? 0.5 : -0.5, (i & 2) ? 0.5 : -0.5, (i & 4) ? 0.5 : -0.5);
      const Vector3d corner = X_FO * rod_size.cwiseProduct(sign);
      depth = std::max(depth, corner.cwiseAbs().maxCoeff() - (room - 0.5 * wall));
    }
    outside = depth > wall;
  } else {
    depth = ring_depth(*setting.ring, X_FO);
    outside = !linked(X_FO);
  }
  result.penetration = std::max(result.penetration, depth);
  result.passed_through = result.passed_through || outside;
}

}  // namespace

const std::vector<StressScene>& stress_scenes() {
  static const std::vector<StressScene> all{StressScene::rod_in_room, StressScene::ring_on_rod};
  return all;
}

std::string name_of(StressScene scene) {
  switch (scene) {
    case StressScene::rod_in_room:
      return "rod_in_room";
    case StressScene::ring_on_rod:
      return "ring_on_rod";
  }
  throw std::logic_error("a scene without a name");
}

StressResult run(const StressMotion& motion) {
  std::mt19937 random(motion.seed);
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  const Matrix3d R_scene = math::exp_so3(in_ball(M_PI, random)), R_held = math::exp_so3(in_ball(M_PI, random));
  const Setting setting = set_scene(motion, R_scene, R_held);
  simulation::SimulationSettings set;
  set.grasp.object = "held";
  set.fork.length = 0.05;
  const double k = 2000.0 * std::pow(10.0, unit(random));
  set.fork.stiffness = {k, k, 1e-3 * k};
  set.fork.damping_ratio = {motion.damping_ratio, motion.damping_ratio, motion.damping_ratio};
  simulation::Simulation simulation(setting.scene, set);

  RigidTransform X_WH = at_middle(R_held);
  X_WH.translation() -= set.fork.length * R_held.col(2);
  Vector3d v = Vector3d::Zero(), w = v;
  const int samples = static_cast<int>(std::lround(duration / sample_time));
  for (int i = 0; i <= samples; ++i) {
    if (i % 5 == 0) v = in_ball(max_speed_seen, random), w = in_ball(max_turning, random);
    simulation.push_stylus({sample_time * i, X_WH});
    const Vector3d next = X_WH.translation() + sample_time * v - middle;
    for (int axis = 0; axis < 3; ++axis) {
      if (std::abs(next[axis]) > hand_reach) v[axis] = -v[axis];
    }
    X_WH.translation() += sample_time * v;
    X_WH.linear() = math::exp_so3(sample_time * w) * X_WH.linear();
  }
  StressResult result;
  const double begin = processor_time();
  for (double t = 0.0; t < duration + 1e-9; t += 0.002) {
    const simulation::AdvanceReport report = simulation.advance_to(t);
    result.steps += static_cast<int>(report.steps);
    result.steps_blocked += report.steps_blocked;
    result.time_lost += report.time_lost;
    result.rejected += report.steps_rejected;
    look(motion, setting, simulation.objects()[0].X_WO, result);
  }
  result.seconds = processor_time() - begin;
  return result;
}

}  // namespace spring_workbench::benchmark
