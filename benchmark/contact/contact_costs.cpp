#include "benchmark/contact/contact_costs.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "benchmark/least_time.h"
#include "spring_workbench/contact/contact_engines.h"
#include "spring_workbench/simulation/simulation.h"
#include "spring_workbench/validation/input_error.h"

namespace spring_workbench::benchmark {
namespace {

constexpr double sample_time = 0.02, edge = 0.1;  // s, m
constexpr int warm = 20, counted = 40, windows = 4;

scene::Body box(const std::string& name, const Vector3d& p_WO) {
  scene::Body body;
  body.name = name;
  body.movable = true;
  body.X_WO.translation() = p_WO;
  body.mass_properties.mass = 1.0;
  body.mass_properties.inertia_O = edge * edge / 6.0 * Matrix3d::Identity();
  body.collision.push_back({geometry::Box{Vector3d::Constant(edge)}});
  return body;
}

scene::Scene scene_of(scene::ContactMode contact) {
  scene::Scene scene;
  scene.name = scene.path = "costs";
  scene.contact = contact;
  scene.bodies = {box("held", Vector3d(0, 0, 0.5 * edge)), box("other", Vector3d(0.3, 0, 0.5 * edge))};
  return scene;
}

/// Motion of the hand while steps are counted.
struct Carry {
  const char* part;
  double height;  ///< of the tip above the held box's centre at rest [m]
  double speed;   ///< along x, towards the other one [m/s]
  double ahead;   ///< start position along x [m]
};

double step_cost(scene::ContactMode contact, const Carry& carry) {
  simulation::SimulationSettings set;
  set.grasp.object = "held";
  simulation::Simulation simulation(scene_of(contact), set);
  const auto x = [&](double t) {
    const double moved = std::max(0.0, t - warm * sample_time);
    return carry.ahead * std::min(1.0, t / (warm * sample_time)) + carry.speed * moved;
  };
  double best = std::numeric_limits<double>::infinity(), used = 0.0;
  for (int i = 0; i <= warm + counted; ++i) {
    const double t = i * sample_time;
    const Vector3d p(x(t), 0.0, 0.5 * edge + set.fork.length + carry.height * std::min(1.0, t / 0.2));
    simulation.push_stylus({t, make_transform(p, Quaterniond(0.0, 1.0, 0.0, 0.0))});
    const double begin = thread_nanoseconds();
    simulation.advance_to(t);
    used += thread_nanoseconds() - begin;
    if (i <= warm) used = 0.0;
    if (i <= warm || (i - warm) % (counted / windows) != 0) continue;
    best = std::min(best, used / (counted / windows));
    used = 0.0;
  }
  return best;
}

void add_queries(std::vector<ContactCost>& costs) {
  const std::unique_ptr<collision::CollisionWorld> world =
      contact::open_collision_world(scene_of(scene::ContactMode::stop));
  RigidTransform high = RigidTransform::Identity(), low = high, on = high, in = high;
  high.translation().z() = 1.0;
  low.translation() = Vector3d(0.1, 0.0, 0.5 * edge + 5e-3);
  on.translation().z() = 0.5 * edge;
  in.translation() = Vector3d(0.22, 0.0, 0.5 * edge + 5e-3);
  RigidTransform high_on = high;
  high_on.translation().x() += 0.02;
  volatile double sink = 0.0;
  const auto note = [&](const char* part, auto&& call) { costs.push_back({"stop", part, min_nanoseconds(200, call)}); };
  note("query: is anything near the way, nothing is", [&](int) { sink = world->may_touch(0, high, high_on, 1e-4); });
  note("query: is anything near the way, something is", [&](int) { sink = world->may_touch(0, on, low, 1e-4); });
  note("query: contact points of a flush box", [&](int) {
    std::vector<collision::ContactPoint> points;
    world->find_contacts(0, on, -1e-4, points);
    sink = static_cast<double>(points.size());
  });
  note("query: sweep of 20 mm past what is near, free", [&](int) {
    RigidTransform end = low;
    end.translation().x() += 0.02;
    sink = world->sweep(0, low, end, 1e-6, 2e-4, 8).free_fraction;
  });
  note("query: sweep of 120 mm into a box", [&](int) { sink = world->sweep(0, low, in, 1e-6, 2e-4, 8).free_fraction; });
}

void add_world(std::vector<ContactCost>& costs) {
  std::unique_ptr<rigid_bodies::RigidWorld> world;
  try {
    world = contact::open_rigid_world(scene_of(scene::ContactMode::dynamic));
  } catch (const validation::InputError&) {
    return;  // this mode was not built
  }
  std::vector<rigid_bodies::DrivenBody> none;
  const auto note = [&](const char* part, auto&& call) {
    costs.push_back({"dynamic", part, min_nanoseconds(200, call)});
  };
  note("world: a step of 2 ms, all asleep", [&](int) { world->step(2e-3, none); });
  note("world: a step of 2 ms, a box slides", [&](int i) {
    Twist moving;
    moving.linear.x() = 0.5;
    RigidTransform X = RigidTransform::Identity();
    X.translation() = Vector3d(-1.0, 0.0, 0.5 * edge);
    if (i == 0) world->place(0, X, moving, true);
    world->step(2e-3, none);
  });
}

}  // namespace

std::vector<ContactCost> measure_contact_costs() {
  std::vector<ContactCost> costs;
  add_queries(costs);
  add_world(costs);
  const bool with_world = std::any_of(costs.begin(), costs.end(), [](const auto& c) { return c.contact == "dynamic"; });
  for (const auto& [name, mode] :
       {std::pair{"none", scene::ContactMode::none}, std::pair{"stop", scene::ContactMode::stop},
        std::pair{"dynamic", scene::ContactMode::dynamic}}) {
    if (mode == scene::ContactMode::dynamic && !with_world) continue;
    for (const Carry& carry : {Carry{"step of 20 ms: carried freely", 0.5, 0.1, 0.0},
                               Carry{"step of 20 ms: carried 10 mm over the bench", 0.015, 0.1, 0.0},
                               Carry{"step of 20 ms: pressed flush and dragged", -0.01, 0.1, 0.0},
                               Carry{"step of 20 ms: against another box", 0.015, 0.05, 0.21}}) {
      costs.push_back({name, carry.part, step_cost(mode, carry)});
    }
  }
  return costs;
}

}  // namespace spring_workbench::benchmark
