#include "benchmark/contact/drops.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <random>
#include <string>

#include "benchmark/contact/bodies.h"
#include "benchmark/contact/let_go.h"
#include "spring_workbench/geometry/shape_queries.h"
#include "spring_workbench/math/so3.h"

namespace spring_workbench::benchmark {
namespace {

constexpr double gravity = 9.81;                                                        // m/s²
constexpr double held = 0.06, after = 0.2;                                              // s
constexpr std::array<double, 8> steps{0.02, 0.01, 5e-3, 2e-3, 1e-3, 5e-4, 2e-4, 1e-4};  // s
constexpr std::array<const char*, 4> shape_names{"box", "hull", "cylinder", "mesh"};

struct Thrown {
  scene::Body body;
  std::vector<Vector3d> corners;  ///< points that include the lowest point; for a cylinder a fine sampling of its rims
  double step = 0.0, tilt = 0.0;
  Vector3d v = Vector3d::Zero(), w = Vector3d::Zero();  ///< velocities of the hand [m/s, rad/s]
};

Thrown thrown_of(unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  const auto between = [&](double a, double b) { return a + (b - a) * unit(random); };
  const auto decades = [&](double a, double b) { return a * std::pow(b / a, unit(random)); };
  Thrown t;
  const double radius = between(0.02, 0.08), height = between(0.1, 0.4) * radius, mass = decades(0.01, 100.0);
  const double friction = unit(random) < 0.3 ? 0.0 : unit(random);
  t.tilt = decades(1e-7, 0.1);
  t.step = steps[static_cast<std::size_t>(8.0 * unit(random))];
  const Matrix3d R =
      math::exp_so3(t.tilt * (Eigen::AngleAxisd(between(0.0, 6.28), Vector3d::UnitZ()) * Vector3d::UnitX())) *
      Eigen::AngleAxisd(between(0.0, 6.28), Vector3d::UnitZ()).toRotationMatrix();
  RigidTransform X_WO = at(Vector3d(0.0, 0.0, radius * t.tilt + height + between(0.02, 0.3)));
  X_WO.linear() = R;
  const auto made = [&](const geometry::Geometry& geometry) { return uniform("held", geometry, X_WO, friction, mass); };
  const auto mesh_body = [&](const std::vector<double>& radii) {
    const geometry::MeshPtr mesh = prism(radii, height);
    t.body = made(mesh);
    t.corners = mesh->vertices;
  };
  switch (seed % shape_names.size()) {
    case 0: {
      const Vector3d size(2.0 * radius, between(1.0, 2.0) * radius, height);
      t.body = made(geometry::Box{size});
      for (int i = 0; i < 8; ++i) {
        t.corners.push_back(0.5 * size.cwiseProduct(Vector3d((i & 1) ? 1 : -1, (i & 2) ? 1 : -1, (i & 4) ? 1 : -1)));
      }
      break;
    }
    case 1:
      mesh_body(std::vector<double>(5 + static_cast<std::size_t>(4.0 * unit(random)), radius));
      break;
    case 2:
      t.body = made(geometry::Cylinder{radius, height});
      t.corners = prism(std::vector<double>(720, radius), height)->vertices;
      break;
    default: {
      std::vector<double> star(10, radius);
      for (std::size_t i = 1; i < star.size(); i += 2) star[i] = 0.5 * radius;
      mesh_body(star);
    }
  }
  if (unit(random) < 0.5) {
    t.v.z() = -between(0.0, 4.0);
    if (friction == 0.0) t.v.x() = between(0.0, 2.0);
    t.w = decades(1e-7, 1e-2) * Vector3d(unit(random) - 0.5, unit(random) - 0.5, unit(random) - 0.5);
  }
  t.body.X_WO.translation().z() -= held * t.v.z();
  return t;
}

double lowest(const Thrown& t, const RigidTransform& X_WO) {
  double z = X_WO.translation().z();
  for (const Vector3d& corner : t.corners) z = std::min(z, (X_WO * corner).z());
  return z;
}

double energy(const scene::Body& body, const bodies::BodyState& o) {
  const Vector3d w_O = o.X_WO.linear().transpose() * o.V_WO_W.angular;
  const scene::MassProperties& m = body.mass_properties;
  return 0.5 * m.mass * o.V_WO_W.linear.squaredNorm() + 0.5 * w_O.dot(m.inertia_O * w_O) +
         m.mass * gravity * o.X_WO.translation().z();
}

}  // namespace

DropResult run(const Drop& drop) {
  const Thrown t = thrown_of(drop.seed);
  scene::Scene scene;
  scene.name = scene.path = "drop";
  scene.contact = drop.contact;
  scene.bodies = {t.body};
  scene.bench_material.friction = t.body.material.friction;
  scene.bench_material.restitution = 0.0;
  scene.bodies[0].material.restitution = 0.0;
  simulation::Simulation s = let_go(scene, t.step, held, t.v, t.w);
  DropResult r;
  r.tilt = t.tilt;
  double min_energy = energy(t.body, s.objects()[0]), fastest = 0.0, end = 2.0;
  bool landed = false;
  for (int i = 1; held + i * t.step < end; ++i) {
    const simulation::AdvanceReport report = s.advance_to(held + i * t.step);
    const bodies::BodyState& o = s.objects()[0];
    r.steps_blocked += report.steps_blocked;
    const double e = energy(t.body, o), vz = o.V_WO_W.linear.z();
    r.energy_gained = std::max(r.energy_gained, e - min_energy);
    min_energy = std::min(min_energy, e);
    r.rest_gap = lowest(t, o.X_WO);
    r.depth = std::max(r.depth, -r.rest_gap);
    if (!landed && (o.in_contact || vz > -fastest)) {
      landed = true;
      end = held + i * t.step + after;
    }
    if (!landed) fastest = -vz;
    if (!landed) continue;
    r.leaving = std::max(r.leaving, vz);
    r.spin = std::max(r.spin, o.V_WO_W.angular.norm());
  }
  r.impact_speed = fastest + gravity * t.step;  // at most
  r.leaving /= r.impact_speed;
  r.energy_gained /= 0.5 * t.body.mass_properties.mass * r.impact_speed * r.impact_speed;
  return r;
}

void run_drops(int count, int first, std::ostream& out) {
  out << "contact,shape,drops,leaving_over_1%,of_them_below_0.03_rad,leaving_%,worst_seed,energy_gained_%,depth_mm,"
         "rest_gap_mm,"
         "steps_blocked\n";
  for (const scene::ContactMode mode : {scene::ContactMode::stop, scene::ContactMode::dynamic}) {
    std::map<std::string, DropResult> worst;
    std::map<std::string, std::array<int, 4>> counts;
    for (int seed = first; seed < first + count; ++seed) {
      const DropResult r = run({mode, static_cast<unsigned>(seed)});
      const std::string shape = shape_names[static_cast<std::size_t>(seed) % shape_names.size()];
      DropResult& w = worst[shape];
      std::array<int, 4>& c = counts[shape];
      ++c[0];
      c[1] += r.leaving > 0.01 ? 1 : 0;
      c[3] += r.leaving > 0.01 && r.tilt < 0.03 ? 1 : 0;
      if (r.leaving > w.leaving) c[2] = seed;
      w.leaving = std::max(w.leaving, r.leaving);
      w.energy_gained = std::max(w.energy_gained, r.energy_gained);
      w.depth = std::max(w.depth, r.depth);
      w.rest_gap = std::max(w.rest_gap, r.rest_gap);
      w.steps_blocked += r.steps_blocked;
    }
    for (const auto& [shape, w] : worst) {
      const std::array<int, 4>& c = counts[shape];
      out << name_of(mode) << ',' << shape << ',' << c[0] << ',' << c[1] << ',' << c[3] << ',' << 100.0 * w.leaving
          << ',' << c[2] << ',' << 100.0 * w.energy_gained << ',' << 1e3 * w.depth << ',' << 1e3 * w.rest_gap << ','
          << w.steps_blocked << std::endl;
    }
  }
}

}  // namespace spring_workbench::benchmark
