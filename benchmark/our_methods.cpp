#include "benchmark/our_methods.h"

#include <utility>

#include "benchmark/simulated_rod.h"
#include "spring_workbench/dynamics/integrator.h"
#include "spring_workbench/validation/names.h"

namespace spring_workbench::benchmark {
namespace {

/// A hand that is a function of time, sampled at the end of every step of `h` [s]. One extra pose right after the first
/// makes the initial velocity, which is that of a chord, equal to the function's.
PoseSource poses_of_function(const Scenario& scene, double h) {
  constexpr double soon = 1e-8;  // s
  return [&scene, h](std::size_t i) -> motion::PoseSample {
    const double t = i < 2 ? static_cast<double>(i) * soon : static_cast<double>(i - 1) * h;
    const HandState handle = handle_state(scene, t);
    return {t, make_transform(Quaterniond(handle.R_WT), handle.p_WT)};
  };
}

class OurMethod : public Method {
 public:
  explicit OurMethod(std::string integrator)
      : integrator_(std::move(integrator)), solves_(solves_the_equation_of_motion(integrator_)) {}

  std::string name() const override { return integrator_; }
  bool ours() const override { return true; }
  /// A single spring is the same for all.
  bool has_scene_law(const Scenario& scene) const override { return solves_ || scene.kind != SceneKind::six_dof; }

  RunResult run(const Scenario& scene, double step) const override {
    const RodCase one = rod_case(scene);
    const PoseSource poses = scene.samples ? poses_of_tracker(one) : poses_of_function(scene, step_length(scene, step));
    return as_result(scene, run_simulated(one, "bushing", integrator_, step, 0.0, poses));
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
