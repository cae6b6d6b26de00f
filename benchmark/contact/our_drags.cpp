#include <cmath>

#include "benchmark/contact/drag.h"
#include "benchmark/contact/motion_steps.h"
#include "spring_workbench/simulation/simulation.h"

namespace spring_workbench::benchmark {
namespace {

constexpr double sample_time = 0.02;      // s
constexpr double slab_mass = 1000.0;      // kg
const Vector3d slab_size(2.0, 1.0, 0.1);  // m

scene::Scene scene_of(const DragScene& drag, scene::ContactMode contact) {
  scene::Scene scene;
  scene.name = scene.path = "drag";
  scene.contact = contact;
  scene.gravity = drag.gravity;
  scene.bench_material.friction = drag.friction;
  scene::Body box;
  box.name = "box";
  box.movable = true;
  box.X_WO.translation().z() = 0.5 * drag.size.z();
  box.mass_properties.mass = drag.mass;
  box.mass_properties.inertia_O = drag.inertia().asDiagonal();
  box.material.friction = drag.friction;
  box.collision.push_back({geometry::Box{drag.size}});
  scene.bodies.push_back(box);
  if (contact == scene::ContactMode::dynamic) {
    // On the bench `dynamic` behaves like `stop`; a movable slab as the plane makes sure that the rigid-body world is
    // used.
    scene::Body slab = box;
    slab.name = "slab";
    slab.X_WO.translation().z() = -0.5 * slab_size.z();
    slab.mass_properties.mass = slab_mass;
    slab.mass_properties.inertia_O =
        slab_mass / 12.0 *
        (slab_size.squaredNorm() * Matrix3d::Identity() - Matrix3d(slab_size.cwiseAbs2().asDiagonal()));
    slab.collision = {{geometry::Box{slab_size}}};
    scene.bodies.push_back(slab);
    scene.bench_height = -slab_size.z();
    scene.bench_material.friction = 4.0;  // so that the slab does not slide
  }
  return scene;
}

simulation::SimulationSettings settings_of(const DragScene& drag, double step) {
  simulation::SimulationSettings set;
  const double k = drag.stiffness(), turning = drag.turning_stiffness();
  set.fork.shape = rod::ShapeKind::bushing;
  set.fork.length = std::sqrt(3.0 * turning / k);  // so that bending has the same rotational stiffness
  set.fork.stiffness = {k, k, turning};
  set.grasp.object = "box";
  set.dynamics.step = step;
  return set;
}

class OurDrag final : public DragWorld {
 public:
  OurDrag(const DragScene& drag, double step, scene::ContactMode contact)
      : simulation_(scene_of(drag, contact), settings_of(drag, step)) {
    const double length = simulation_.settings().fork.length;
    for (int i = 0; sample_time * i < drag_duration + 0.5 * sample_time; ++i) {
      const double t = sample_time * i;
      const Vector3d p = drag_hand(drag, t).p_W + length * Vector3d::UnitZ();
      simulation_.push_stylus({t, make_transform(p, Quaterniond(0.0, 1.0, 0.0, 0.0))});
    }
    simulation_.advance_to(0.0);
  }
  void step(double t, double h) override { simulation_.advance_to(t + h); }
  RigidTransform box() const override { return simulation_.objects()[0].X_WO; }

 private:
  simulation::Simulation simulation_;
};

}  // namespace

std::vector<DragMethod> our_drags() {
  const auto make = [](scene::ContactMode contact) {
    return [contact](const DragScene& drag, double step) -> std::unique_ptr<DragWorld> {
      return std::make_unique<OurDrag>(drag, step, contact);
    };
  };
  std::vector<DragMethod> drags{{"stop", false, make(scene::ContactMode::stop)}};
  if (has_dynamic_contact()) drags.push_back({"dynamic", false, make(scene::ContactMode::dynamic)});
  return drags;
}

}  // namespace spring_workbench::benchmark
