#include "benchmark/our_methods.h"

#include <cmath>
#include <utility>

#include "benchmark/stepping_loop.h"
#include "spring_workbench/dynamics/integrator.h"
#include "spring_workbench/math/so3.h"

namespace spring_workbench::benchmark {
namespace {

/// The scene on a fork so long that the bushing's `k_slope = k_bend L² / 3` is the scene's; the motion does not depend
/// on it.
Scenario with_length_of_its_slopes(Scenario scene) {
  if (scene.kind == SceneKind::six_dof) scene.length = std::sqrt(3.0 * scene.stiffness[3] / scene.stiffness[0]);
  return scene;
}

PerFamily families(const Vector6d& coordinates) { return {coordinates[2], coordinates[0], coordinates[5]}; }

HeldBody held_body(const Scenario& scene) {
  BodyInertia inertia;
  inertia.mass = scene.mass;
  inertia.inertia_O = scene.inertia.asDiagonal();
  inertia.X_OE.translation() = -scene.p_EO;
  HeldBody body(make_shape_model("bushing", scene.length), inertia, scene.gravity);
  body.set_springs_and_dampers(families(scene.stiffness), families(scene.damping));
  if (scene.kind != SceneKind::six_dof) {
    ForkDofs dofs;
    dofs.bend = false;
    dofs.stretch = scene.kind == SceneKind::stretch;
    dofs.torsion = scene.kind == SceneKind::torsion;
    body.set_dofs(dofs, 0.0, 1.0, body.zero_state());
  }
  return body;
}

/// The handle as a motion between samples `interval` apart, built as time goes on.
class SampledHand {
 public:
  SampledHand(const Scenario& scene, double interval) : scene_(scene), interval_(interval), newest_(sample(0.0)) {}

  /// The segment of the step that starts at `t`; steps come in order.
  const MotionSegment& at(double t) {
    if (t > newest_.pose.t - 1e-9) {
      const Sample older = newest_;
      newest_ = sample(interval_ * static_cast<double>(++count_));
      segment_ = MotionSegment(older.pose, older.v_W, older.w_H, newest_.pose, newest_.v_W, newest_.w_H);
    }
    return segment_;
  }

 private:
  struct Sample {
    PoseSample pose;
    Vector3d v_W, w_H;
  };

  Sample sample(double t) const {
    const HandState handle = handle_state(scene_, t);
    Sample s{{t, RigidTransform::Identity()}, handle.v_WT_W, handle.w_WT_T};
    s.pose.X.linear() = handle.R_WT;
    s.pose.X.translation() = handle.p_WT;
    return s;
  }

  const Scenario& scene_;
  double interval_;
  long count_ = 0;
  Sample newest_;
  MotionSegment segment_{RigidTransform::Identity()};
};

class OurMethod : public Method {
 public:
  OurMethod(std::string integrator, bool fine_hand) : integrator_(std::move(integrator)), fine_hand_(fine_hand) {}

  std::string name() const override { return fine_hand_ ? integrator_ + "_fine_hand" : integrator_; }

  RunResult run(const Scenario& given, double step) const override {
    const Scenario scene = with_length_of_its_slopes(given);
    const HeldBody body = held_body(scene);
    const std::unique_ptr<Integrator> integrator = make_integrator(integrator_);
    StrainState state = body.zero_state();
    SampledHand hand(scene, scene.output_interval / samples_per_output(steps_per_output(scene, step)));
    const MotionSegment* segment = &hand.at(0.0);
    return stepping_loop(
        scene, step,
        [&](double t, double h) {
          segment = &hand.at(t);
          integrator->step(body, *segment, t, h, state);
        },
        [&](double t) -> Vector3d {
          const HandleForcing handle = body.forcing(*segment, t);
          if (scene.kind != SceneKind::torsion) return body.object(handle, state).X.translation();
          return {0.0, 0.0, log_so3(handle.X_WH.linear()).z() + state.q[0]};
        });
  }

 private:
  int samples_per_output(int steps) const {
    constexpr int most = 64;
    if (!fine_hand_) return 1;
    int stride = (steps + most - 1) / most;
    while (steps % stride != 0) ++stride;
    return steps / stride;
  }

  std::string integrator_;
  bool fine_hand_;
};

}  // namespace

std::vector<MethodPtr> our_methods() {
  std::vector<MethodPtr> methods;
  for (const std::string& name : integrator_names()) {
    for (const bool fine_hand : {false, true}) methods.push_back(std::make_unique<OurMethod>(name, fine_hand));
  }
  return methods;
}

}  // namespace spring_workbench::benchmark
