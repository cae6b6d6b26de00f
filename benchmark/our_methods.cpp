#include "benchmark/our_methods.h"

#include <chrono>
#include <cmath>
#include <limits>
#include <utility>

#include "benchmark/dense_output.h"
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

/// The handle as a function of time.
class FunctionHand final : public FrameMotion {
 public:
  explicit FunctionHand(const Scenario& scene) : scene_(scene) {}

  const FrameMotion& at(double) const { return *this; }

  OwnAxesMotion in_own_axes(double t) const override {
    const HandMotion& hand = motion(t);
    OwnAxesMotion m;
    m.X.linear() = hand.state.R_WT;
    m.X.translation() = hand.state.p_WT;
    m.v_W = hand.state.v_WT_W;
    m.a_W = hand.acceleration.a_WT_W;
    m.w_B = hand.state.w_WT_T;
    m.alpha_B = hand.acceleration.alpha_WT_T;
    return m;
  }
  FrameForcing<Pack> forcing(const Pack& t, double gravity) const override {
    FrameForcing<Pack> f;
    for (int i = 0; i < pack_size; ++i) {
      const HandMotion& hand = motion(t[i]);
      const ThreeByThree<double> R = three_by_three(hand.state.R_WT);
      set_lane(f.R_WB, i, R);
      set_lane(f.w_B, i, three(hand.state.w_WT_T));
      set_lane(f.alpha_B, i, three(hand.acceleration.alpha_WT_T));
      set_lane(f.a_B, i, transposed(R, three(hand.acceleration.a_WT_W) + Three<double>{0.0, 0.0, gravity}));
    }
    return f;
  }

 private:
  /// Asked once where a step begins at the end of the last one.
  const HandMotion& motion(double t) const {
    if (t != t_) newest_ = handle_motion(scene_, t_ = t);
    return newest_;
  }

  const Scenario& scene_;
  mutable double t_ = std::numeric_limits<double>::quiet_NaN();
  mutable HandMotion newest_;
};

/// The handle by the poses of a tracker that samples once an output interval.
class SampledHand {
 public:
  explicit SampledHand(const Scenario& scene) : scene_(scene) {
    for (; newest_ < 1; ++newest_) track_.push(handle_sample(scene, newest_ * scene.output_interval));
  }

  /// The segment of the step that starts at `t`; steps come in order. The tracker is a sample ahead of its end.
  const FrameMotion& at(double t) {
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

/// One step that is thrown away: what an integrator derives from stiffness and mass is set up, as the peers' models are.
void set_up(const Scenario& scene, const HeldBody& body, double step, Integrator& integrator) {
  StrainState state = body.zero_state();
  integrator.step(body, FunctionHand(scene), 0.0, step, state);
}

template <typename Hand>
RunResult run_on(const Scenario& scene, const std::string& name, double step, Hand hand) {
  const HeldBody body = held_body(scene);
  const std::unique_ptr<Integrator> integrator = make_integrator(name);
  set_up(scene, body, scene.output_interval / steps_per_output(scene, step), *integrator);
  StrainState state = body.zero_state();
  const FrameMotion* motion = &hand.at(0.0);
  return stepping_loop(
      scene, step,
      [&](double t, double h) {
        motion = &hand.at(t);
        integrator->step(body, *motion, t, h, state);
      },
      [&](double t) -> Vector3d {
        const HandleForcing handle = body.forcing(*motion, t);
        if (scene.kind != SceneKind::torsion) return body.object(handle, state).X.translation();
        return {0.0, 0.0, log_so3(handle.X_WH.linear()).z() + state.q[0]};
      });
}

Moment moment(const Scenario& scene, const HeldBody& body, const HandleForcing& handle, const StrainState& state) {
  const StrainVector q_ddot = body.acceleration(handle, state.q, state.q_dot);
  if (scene.kind == SceneKind::torsion) {
    return {handle.t, Vector3d(0.0, 0.0, log_so3(handle.X_WH.linear()).z() + state.q[0]),
            Vector3d(0.0, 0.0, handle.angular_velocity.z() + state.q_dot[0]),
            Vector3d(0.0, 0.0, handle.angular_acceleration.z() + q_ddot[0])};
  }
  const MotionState o = body.object(handle, state, &q_ddot);
  return {handle.t, o.X.translation(), o.velocity.linear, o.acceleration.linear};
}

/// The steps with which a run in long steps begins: what the start sets off is followed until it has died away.
struct Start {
  double step, duration;  ///< [s]

  Start(const Scenario& scene, double largest_step) {
    const bool single = scene.kind != SceneKind::six_dof;
    const double omega = single ? std::sqrt(scene.stiffness[scene.single_coordinate()] / scene.single_inertia())
                                : std::sqrt(scene.stiffness[0] / scene.mass);
    step = std::min(largest_step, std::max(1.5 / omega, scene.output_interval));
    duration = std::max(10.0 / omega, 3.0 * step);
  }
};

/// In steps that do not end at the outputs.
RunResult run_in_long_steps(const Scenario& scene, const std::string& name, double step) {
  const HeldBody body = held_body(scene);
  const std::unique_ptr<Integrator> integrator = make_integrator(name);
  const std::vector<double> times = output_times(scene);
  const Start begin(scene, step);
  const FunctionHand hand(scene);
  set_up(scene, body, begin.step, *integrator);
  StrainState state = body.zero_state();
  DenseOutput dense;
  RunResult result;
  result.outputs.reserve(times.size());
  const auto start = std::chrono::steady_clock::now();
  dense.push(moment(scene, body, body.forcing(hand, 0.0), state));
  for (double t = 0.0; result.outputs.size() < times.size();) {
    const double h = t < begin.duration - 1e-9 ? begin.step : step;
    integrator->step(body, hand, t, h, state);
    t += h;
    const Moment end = moment(scene, body, body.forcing(hand, t), state);
    if (!is_bounded(end.value)) return result;
    dense.push(end);
    dense.append(times, result.outputs);
  }
  result.wall_seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  result.finite = true;
  return result;
}

class OurMethod : public Method {
 public:
  OurMethod(std::string integrator, bool samples) : integrator_(std::move(integrator)), samples_(samples) {}

  std::string name() const override { return integrator_; }
  std::string hand() const override { return samples_ ? "samples" : "function"; }
  bool dense() const override { return !samples_; }

  RunResult run(const Scenario& given, double step) const override {
    const Scenario scene = with_length_of_its_slopes(given);
    if (dense() && step > (1.0 + 1e-9) * scene.output_interval) return run_in_long_steps(scene, integrator_, step);
    if (samples_) return run_on(scene, integrator_, step, SampledHand(scene));
    return run_on(scene, integrator_, step, FunctionHand(scene));
  }

 private:
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
