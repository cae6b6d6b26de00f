#include "benchmark/contact/throws.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <string>
#include <vector>

#include "benchmark/contact/bodies.h"
#include "benchmark/contact/let_go.h"
#include "benchmark/contact/processor_time.h"
#include "spring_workbench/math/so3.h"

namespace spring_workbench::benchmark {
namespace {

constexpr double held = 0.04;                                             // s
constexpr double thickness = 1e-3, fixed_width = 8.0, loose_width = 2.0;  // m, of the wall
constexpr std::array<const char*, 4> shape_names{"card", "rod", "cylinder", "star"};

struct Thing {
  scene::Body body;
  std::vector<Vector3d> corners;  ///< in the object frame; for a cylinder a fine sampling of its rims
  Vector3d v, w;                  ///< velocities at release [m/s, rad/s]
  double restitution = 0.0, step = 0.0;
};

Thing thing_of(unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  const auto between = [&](double a, double b) { return a + (b - a) * unit(random); };
  const auto direction = [&] { return Vector3d(between(-1, 1), between(-1, 1), between(-1, 1)).normalized(); };
  Thing t;
  t.v = Vector3d(between(1.0, 15.0), between(-1.0, 1.0), between(-1.0, 1.0));
  t.w = between(0.0, 50.0) * direction();
  t.restitution = unit(random) < 0.5 ? 0.0 : unit(random);
  t.step = unit(random) < 0.5 ? 0.02 : 0.01;
  RigidTransform X_WO = at(Vector3d(-between(0.3, 0.6), 0.0, 0.0) - held * t.v);
  X_WO.linear() = math::exp_so3(between(0.0, 3.14) * direction());
  const auto made = [&](const geometry::Geometry& geometry, double mass, const std::vector<Vector3d>& corners) {
    t.body = uniform("thrown", geometry, X_WO, 0.3, mass);
    t.corners = corners;
  };
  const auto box = [&](const Vector3d& size, double mass) {
    std::vector<Vector3d> corners;
    for (int i = 0; i < 8; ++i) {
      corners.push_back(0.5 * size.cwiseProduct(Vector3d((i & 1) ? 1 : -1, (i & 2) ? 1 : -1, (i & 4) ? 1 : -1)));
    }
    made(geometry::Box{size}, mass, corners);
  };
  const geometry::MeshPtr star = prism({0.04, 0.015, 0.04, 0.015, 0.04, 0.015, 0.04, 0.015}, 0.03);
  switch (seed % shape_names.size()) {
    case 0:
      box({0.06, 0.09, thickness}, 0.01);
      break;
    case 1:
      box({0.01, 0.01, 0.3}, 0.1);
      break;
    case 2:
      made(geometry::Cylinder{0.02, 0.1}, 0.1, prism(std::vector<double>(720, 0.02), 0.1)->vertices);
      break;
    default:
      made(star, 0.1, star->vertices);
  }
  return t;
}

/// Conserved quantities without gravity: momentum, angular momentum about the origin; and the energy.
struct Kept {
  Vector6d momentum = Vector6d::Zero();
  double energy = 0.0;

  void add(const scene::MassProperties& m, const bodies::BodyState& o) {
    const Vector3d p = m.mass * o.V_WO_W.linear, w_O = o.X_WO.linear().transpose() * o.V_WO_W.angular;
    momentum.head<3>() += p;
    momentum.tail<3>() += o.X_WO.translation().cross(p) + o.X_WO.linear() * (m.inertia_O * w_O);
    energy += 0.5 * p.dot(o.V_WO_W.linear) + 0.5 * w_O.dot(m.inertia_O * w_O);
  }
};

scene::Scene scene_of(const Throw& thrown, const Thing& t) {
  const double width = thrown.loose ? loose_width : fixed_width;
  const Vector3d size(thickness, width, width);
  scene::Scene scene;
  scene.name = scene.path = "throw";
  scene.contact = thrown.contact;
  scene.gravity = 0.0;
  scene.bench_height = -100.0;
  scene.bodies = {t.body, standing("wall", geometry::Box{size}, RigidTransform::Identity(), 0.3)};
  if (thrown.loose) scene.bodies[1] = box("wall", size, 0.5, Vector3d::Zero(), 0.3);
  if (thrown.among_others) {
    const RigidTransform X_WP = at(Vector3d(0.5 * thickness + 2e-4 + 0.05, 0.45 * width, 0.0));
    scene.bodies.push_back(standing("post", geometry::Box{Vector3d::Constant(0.1)}, X_WP, 0.3));
  }
  for (scene::Body& body : scene.bodies) body.material.restitution = t.restitution;
  return scene;
}

/// Updates the largest distance of a corner beyond the near face of the wall [m], and whether the centre is beyond it.
/// Points next to the wall do not count.
void look_at_wall(const Thing& t, const RigidTransform& X_AO, double width, ThrowResult& r) {
  const auto beside = [&](const Vector3d& p) { return p.tail<2>().cwiseAbs().maxCoeff() > 0.5 * width; };
  const Vector3d centre = X_AO.translation();
  r.passed_through = r.passed_through || (centre.x() > 0.0 && !beside(centre));
  for (const Vector3d& corner : t.corners) {
    const Vector3d p = X_AO * corner;
    if (!beside(p)) r.depth = std::max(r.depth, p.x() + 0.5 * thickness);
  }
}

}  // namespace

ThrowResult run(const Throw& thrown) {
  const Thing t = thing_of(thrown.seed);
  const scene::Scene scene = scene_of(thrown, t);
  simulation::Simulation s = let_go(scene, t.step, held, t.v, t.w);
  const auto both = [&] {
    Kept kept;
    for (std::size_t i = 0; i < s.objects().size(); ++i) kept.add(scene.bodies[i].mass_properties, s.objects()[i]);
    return kept;
  };
  const Kept start = both();
  const double begin = processor_time(), end = held + 1.2 / t.v.x();
  double least = start.energy;
  ThrowResult r;
  for (double time = held + t.step; time < end; time += t.step) {
    const simulation::AdvanceReport report = s.advance_to(time);
    r.steps_blocked += report.steps_blocked;
    r.steps_unsolved += report.steps_unsolved;
    const RigidTransform X_WA = thrown.loose ? s.objects()[1].X_WO : RigidTransform::Identity();
    look_at_wall(t, X_WA.inverse() * s.objects()[0].X_WO, thrown.loose ? loose_width : fixed_width, r);
    const Kept now = both();
    r.energy_gained = std::max(r.energy_gained, (now.energy - least) / start.energy);
    least = std::min(least, now.energy);
    if (!thrown.loose || thrown.among_others) continue;
    const double changed = (now.momentum - start.momentum).norm() / start.momentum.head<3>().norm();
    r.momentum_changed = std::max(r.momentum_changed, changed);
  }
  r.seconds = (processor_time() - begin) / (end - held);
  return r;
}

void run_throws(int count, int first, std::ostream& out) {
  out << "contact,wall,shape,throws,passed_through,over_0.1_mm,depth_mm,worst_seed,energy_gained_%,most_gaining_seed,"
         "momentum_changed,steps_blocked,most_processor_time\n";
  for (const Throw& kind :
       {Throw{scene::ContactMode::stop, 0, false}, Throw{scene::ContactMode::dynamic, 0, false},
        Throw{scene::ContactMode::dynamic, 0, true}, Throw{scene::ContactMode::dynamic, 0, true, true}}) {
    std::array<ThrowResult, shape_names.size()> worst;
    std::array<std::array<int, 5>, shape_names.size()>
        counts{};  // numbers of throws, passed through, too deep; worst seeds
    for (int seed = first; seed < first + count; ++seed) {
      const ThrowResult r = run({kind.contact, static_cast<unsigned>(seed), kind.loose, kind.among_others});
      const std::size_t shape = static_cast<std::size_t>(seed) % shape_names.size();
      ThrowResult& w = worst[shape];
      std::array<int, 5>& c = counts[shape];
      ++c[0];
      c[1] += r.passed_through ? 1 : 0;
      c[2] += !r.passed_through && r.depth > 1e-4 ? 1 : 0;
      if (!r.passed_through && r.depth > w.depth) {
        w.depth = r.depth;
        c[3] = seed;
      }
      if (r.energy_gained > w.energy_gained) {
        w.energy_gained = r.energy_gained;
        c[4] = seed;
      }
      w.momentum_changed = std::max(w.momentum_changed, r.momentum_changed);
      w.steps_blocked += r.steps_blocked;
      w.seconds = std::max(w.seconds, r.seconds);
    }
    for (std::size_t i = 0; i < shape_names.size(); ++i) {
      const ThrowResult& w = worst[i];
      const std::array<int, 5>& c = counts[i];
      out << name_of(kind.contact) << ','
          << (kind.among_others ? "loose and a post"
              : kind.loose      ? "loose"
                                : "fixed")
          << ',' << shape_names[i] << ',' << c[0] << ',' << c[1] << ',' << c[2] << ',' << 1e3 * w.depth << ',' << c[3]
          << ',' << 100.0 * w.energy_gained << ',' << c[4] << ',' << w.momentum_changed << ',' << w.steps_blocked << ','
          << w.seconds << std::endl;
    }
  }
}

}  // namespace spring_workbench::benchmark
