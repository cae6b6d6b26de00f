#include "benchmark/our_methods.h"

#include <utility>

#include "benchmark/simulated_rod.h"
#include "spring_workbench/dynamics/integrator.h"
#include "spring_workbench/math/so3.h"
#include "spring_workbench/validation/names.h"

namespace spring_workbench::benchmark {
namespace {

/// A hand that is a function of time, sampled at the end of every step of `h` [s]. The initial velocity is that of the
/// chord to the next pose, which therefore follows right after the first one, where the function's velocity leads: so
/// late that the chord is exact to 1e-10 m/s, so soon that the pose is off by some 1e-12 m.
PoseSource poses_of_function(const Scenario& scene, double h) {
  static constexpr double soon = 1e-6;  // s
  return [&scene, h](std::size_t i) -> motion::PoseSample {
    const double t = i < 2 ? 0.0 : static_cast<double>(i - 1) * h;
    const HandState handle = handle_state(scene, t);
    motion::PoseSample pose{t, make_transform(handle.p_WT, Quaterniond(handle.R_WT))};
    if (i != 1) return pose;
    pose.t = soon;
    pose.X.translation() += soon * handle.v_WT_W;
    pose.X.linear() *= math::exp_so3(soon * handle.w_WT_T);
    return pose;
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
