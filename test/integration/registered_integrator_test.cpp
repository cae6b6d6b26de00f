// A user-defined integrator, registered under its own name.
#include <gtest/gtest.h>
#include <yaml-cpp/yaml.h>

#include <memory>
#include <string>

#include "spring_workbench/dynamics/integrator.h"
#include "spring_workbench/simulation/simulation.h"
#include "spring_workbench/validation/names.h"
#include "support/bodies.h"

namespace spring_workbench::simulation {
namespace {

using dynamics::IntegratorKind;

/// Like rk4, but counts its steps.
class Counting : public dynamics::Integrator {
 public:
  static inline int steps = 0;

  int order() const override { return own_->order(); }
  dynamics::StepEstimate step(const dynamics::HeldBody& body, const motion::Trajectory& handle, double t, double h,
                              dynamics::StrainState& state) override {
    ++steps;
    return own_->step(body, handle, t, h, state);
  }
  void archive(math::StateArchive& state) override { own_->archive(state); }

 private:
  std::unique_ptr<dynamics::Integrator> own_ = dynamics::make_integrator(IntegratorKind::rk4);
};

IntegratorKind counting() {
  static const IntegratorKind kind =
      dynamics::register_integrator("counting", [] { return std::make_unique<Counting>(); });
  return kind;
}

/// A box that a hand swings on a soft fork, with the integrator called `name`.
Simulation swinging(const std::string& name) {
  const scene::Scene scene = scene_of({box("box", {0.06, 0.06, 0.06}, 0.5, {0.0, 0.0, 0.2})}, scene::ContactMode::none);
  SimulationSettings settings;
  apply_settings(YAML::Load("{grasp.object: box, step: 0.0005, integrator: " + name +
                            ", fork.stiffness: {stretch: 400, bend: 100, torsion: 1}}"),
                 "test", settings);
  Simulation simulation(scene, settings);
  for (int i = 0; i <= 20; ++i) {
    simulation.push_stylus({0.02 * i, make_transform({0.05 * i * i / 400.0, 0.0, 0.0}, Quaterniond::Identity())});
  }
  return simulation;
}

TEST(RegisteredIntegrator, StepsAsOneOfOurs) {
  counting();
  Simulation own = swinging("counting"), rk4 = swinging("rk4");
  Counting::steps = 0;
  own.advance_to(0.2);
  EXPECT_GE(Counting::steps, 400);
  rk4.advance_to(0.2);
  EXPECT_EQ(validation::name_of(own.tool().integrator), "counting");
  EXPECT_GT((rk4.objects()[0].X_WO.translation() - Vector3d(0.0125, 0.0, 0.2)).norm(), 1e-6) << "nothing moved";
  EXPECT_EQ(own.objects()[0].X_WO.matrix(), rk4.objects()[0].X_WO.matrix());

  const SimulationState state = own.save();
  own.advance_to(0.4);
  const auto ended = own.state_hash();
  own.change({}, DynamicsChange{IntegratorKind::exponential, {}, {}});
  own.restore(state);
  own.advance_to(0.4);
  EXPECT_EQ(own.state_hash(), ended) << "its history belongs to the state";
}

TEST(RegisteredIntegrator, NamesAreTakenOnce) {
  counting();
  for (const char* name : {"", "counting", "exponential"}) {
    EXPECT_THROW(dynamics::register_integrator(name, [] { return std::make_unique<Counting>(); }),
                 validation::InputError)
        << name;
  }
  SimulationSettings settings;
  EXPECT_THROW(apply_settings(YAML::Load("{integrator: counted}"), "test", settings), validation::InputError);
  settings.dynamics.integrator = static_cast<IntegratorKind>(99);
  EXPECT_THROW(validate(settings, "test"), validation::InputError);
}

}  // namespace
}  // namespace spring_workbench::simulation
