#include "benchmark/simulated_rod.h"

#include "spring_workbench/validation/names.h"

namespace spring_workbench::benchmark {

scene::Scene rod_scene(const RodCase& one) {
  scene::Scene scene;
  scene.name = scene.path = one.name;
  scene.contact = scene::ContactMode::none;
  scene::Body body;
  body.name = "object";
  body.movable = true;
  if (one.mass > 0.0) {
    body.mass_properties.mass = one.mass;
    body.mass_properties.inertia_O = one.inertia.asDiagonal();
  }
  body.collision.push_back({geometry::Box{Vector3d(0.1, 0.1, 0.1)}});
  scene.bodies.push_back(body);
  return scene;
}

simulation::SimulationSettings rod_settings(const RodCase& one, const std::string& shape, const std::string& integrator,
                                            double step) {
  simulation::SimulationSettings settings;
  settings.contact = scene::ContactMode::none;
  settings.fork = one.fork;
  settings.fork.shape = validation::named<rod::ShapeKind>(shape, "benchmark", "shape");
  settings.dynamics.integrator = validation::named<dynamics::IntegratorKind>(integrator, "benchmark", "integrator");
  settings.dynamics.step = step;
  settings.grasp.object = "object";
  settings.grasp.start_follow = true;
  settings.grasp.X_OE = RigidTransform(Eigen::Translation3d(one.p_OE));
  return settings;
}

}  // namespace spring_workbench::benchmark
