#include "benchmark/our_methods.h"

#include <utility>

#include "benchmark/function_hand.h"
#include "benchmark/simulated_rod.h"
#include "benchmark/stepping_loop.h"
#include "spring_workbench/dynamics/integrator.h"
#include "spring_workbench/math/so3.h"
#include "spring_workbench/validation/names.h"

namespace spring_workbench::benchmark {
namespace {

/// In steps of the library's integrator, after one that is thrown away: what it derives from stiffness and mass is set
/// up then, as the peers' models are.
RunResult run_on_function(const Scenario& scene, const std::string& name, double step) {
  const dynamics::HeldBody body = held_body(rod_case(scene), "bushing");
  const std::unique_ptr<dynamics::Integrator> integrator =
      dynamics::make_integrator(validation::named<dynamics::IntegratorKind>(name, "benchmark", "integrator"));
  const FunctionHand hand(scene);
  dynamics::StrainState state = body.zero_state();
  integrator->step(body, hand, 0.0, step_length(scene, step), state);
  state = body.zero_state();
  return stepping_loop(
      scene, step, [&](double t, double h) { integrator->step(body, hand, t, h, state); },
      [&](double t) -> Vector3d {
        const dynamics::HandleForcing handle = body.forcing(hand, t);
        if (scene.kind != SceneKind::torsion) return body.object(handle, state).X.translation();
        return {0.0, 0.0, math::log_so3(handle.X_WH.linear()).z() + state.q[0]};  // which no half turn ends
      });
}

class OurMethod : public Method {
 public:
  explicit OurMethod(std::string integrator)
      : integrator_(std::move(integrator)), solves_(solves_the_equation_of_motion(integrator_)) {}

  std::string name() const override { return integrator_; }
  bool ours() const override { return true; }
  /// A single spring is the same to all.
  bool has_scene_law(const Scenario& scene) const override { return solves_ || scene.kind != SceneKind::six_dof; }

  RunResult run(const Scenario& scene, double step) const override {
    if (!scene.samples) return run_on_function(scene, integrator_, step);
    return as_result(scene, run_simulated(rod_case(scene), "bushing", integrator_, step));
  }

 private:
  std::string integrator_;
  bool solves_;
};

}  // namespace

bool solves_the_equation_of_motion(const std::string& integrator) {
  return dynamics::make_integrator(validation::named<dynamics::IntegratorKind>(integrator, "benchmark", "integrator"))
      ->solves_the_equation_of_motion();
}

std::vector<MethodPtr> our_methods() {
  std::vector<MethodPtr> methods;
  for (const std::string& name : validation::names<dynamics::IntegratorKind>()) {
    methods.push_back(std::make_unique<OurMethod>(name));
  }
  return methods;
}

}  // namespace spring_workbench::benchmark
