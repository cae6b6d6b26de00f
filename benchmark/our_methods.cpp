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

PoseSample handle_sample(const Scenario& scene, double t) {
  const HandState handle = handle_state(scene, t);
  PoseSample sample{t, RigidTransform::Identity()};
  sample.X.linear() = handle.R_WT;
  sample.X.translation() = handle.p_WT;
  return sample;
}

/// The handle as a function of time, asked for its pose and velocity at times `interval` apart as time goes on.
class FunctionHand {
 public:
  FunctionHand(const Scenario& scene, double interval) : scene_(scene), interval_(interval), newest_(node(0.0)) {}

  /// The segment of the step that starts at `t`; steps come in order.
  const MotionSegment& at(double t) {
    if (t > newest_.pose.t - 1e-9) {
      const Node older = newest_;
      newest_ = node(interval_ * static_cast<double>(++count_));
      segment_ = MotionSegment(older.pose, older.v_W, older.w_H, newest_.pose, newest_.v_W, newest_.w_H);
    }
    return segment_;
  }

 private:
  struct Node {
    PoseSample pose;
    Vector3d v_W, w_H;
  };

  Node node(double t) const {
    const HandState handle = handle_state(scene_, t);
    Node n{{t, RigidTransform::Identity()}, handle.v_WT_W, handle.w_WT_T};
    n.pose.X.linear() = handle.R_WT;
    n.pose.X.translation() = handle.p_WT;
    return n;
  }

  const Scenario& scene_;
  double interval_;
  long count_ = 0;
  Node newest_;
  MotionSegment segment_{RigidTransform::Identity()};
};

/// The handle by the poses of a tracker that samples once an output interval.
class SampledHand {
 public:
  explicit SampledHand(const Scenario& scene) : scene_(scene) {
    for (; newest_ < 1; ++newest_) track_.push(handle_sample(scene, newest_ * scene.output_interval));
  }

  /// The segment of the step that starts at `t`; steps come in order. The tracker is a sample ahead of its end.
  const MotionSegment& at(double t) {
    for (; (newest_ - 2) * scene_.output_interval < t + 1e-9; ++newest_) {
      track_.push(handle_sample(scene_, newest_ * scene_.output_interval));
      track_.forget_before(t);
    }
    return track_.segment(t + 1e-9);
  }

 private:
  const Scenario& scene_;
  PoseTrack track_;
  int newest_ = -1;  ///< number of the next sample
};

template <typename Hand>
RunResult run_on(const Scenario& scene, const std::string& name, double step, Hand hand) {
  const HeldBody body = held_body(scene);
  const std::unique_ptr<Integrator> integrator = make_integrator(name);
  StrainState state = body.zero_state();
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

class OurMethod : public Method {
 public:
  OurMethod(std::string integrator, bool samples) : integrator_(std::move(integrator)), samples_(samples) {}

  std::string name() const override { return integrator_; }
  std::string hand() const override { return samples_ ? "samples" : "function"; }

  RunResult run(const Scenario& given, double step) const override {
    const Scenario scene = with_length_of_its_slopes(given);
    if (samples_) return run_on(scene, integrator_, step, SampledHand(scene));
    const double interval = scene.output_interval / asked_per_output(steps_per_output(scene, step));
    return run_on(scene, integrator_, step, FunctionHand(scene, interval));
  }

 private:
  /// How often the function is asked in an output interval: a divisor of the number of steps.
  static int asked_per_output(int steps) {
    constexpr int most = 64;
    int stride = (steps + most - 1) / most;
    while (steps % stride != 0) ++stride;
    return steps / stride;
  }

  std::string integrator_;
  bool samples_;
};

}  // namespace

std::vector<MethodPtr> our_methods() {
  std::vector<MethodPtr> methods;
  for (const std::string& name : integrator_names()) {
    for (const bool samples : {false, true}) methods.push_back(std::make_unique<OurMethod>(name, samples));
  }
  return methods;
}

}  // namespace spring_workbench::benchmark
