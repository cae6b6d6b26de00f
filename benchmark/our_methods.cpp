#include "benchmark/our_methods.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <utility>

#include "benchmark/dense_strain.h"
#include "benchmark/stepping_loop.h"
#include "spring_workbench/dynamics/integrator.h"
#include "spring_workbench/math/so3.h"
#include "spring_workbench/validation/names.h"

namespace spring_workbench::benchmark {
namespace {

/// The scene on a fork so long that the bushing's `k_slope = k_bend L² / 3` is the scene's; the motion does not depend
/// on it.
Scenario with_length_of_its_slopes(Scenario scene) {
  if (scene.kind == SceneKind::six_dof) scene.length = std::sqrt(3.0 * scene.stiffness[3] / scene.stiffness[0]);
  return scene;
}

rod::PerDof families(const Vector6d& coordinates) { return {coordinates[2], coordinates[0], coordinates[5]}; }

dynamics::HeldBody held_body(const Scenario& scene) {
  dynamics::BodyInertia inertia;
  inertia.mass = scene.mass;
  inertia.inertia_O = scene.inertia.asDiagonal();
  inertia.X_OE.translation() = -scene.p_EO;
  dynamics::HeldBody body(rod::make_shape_model(rod::ShapeKind::bushing, scene.length), inertia, scene.gravity);
  body.set_springs_and_dampers(families(scene.stiffness), families(scene.damping));
  if (scene.kind != SceneKind::six_dof) {
    rod::ForkDofs dofs;
    dofs.bend = false;
    dofs.stretch = scene.kind == SceneKind::stretch;
    dofs.torsion = scene.kind == SceneKind::torsion;
    body.set_dofs(dofs, 0.0, 1.0, body.zero_state());
  }
  return body;
}

motion::PoseSample handle_sample(const Scenario& scene, double t) {
  const HandState handle = handle_state(scene, t);
  motion::PoseSample sample{t, RigidTransform::Identity()};
  sample.X.linear() = handle.R_WT;
  sample.X.translation() = handle.p_WT;
  return sample;
}

/// The handle as a function of time.
class FunctionHand final : public motion::FrameMotion {
 public:
  explicit FunctionHand(const Scenario& scene) : scene_(scene) {}

  const motion::FrameMotion& at(double) const { return *this; }

  motion::OwnAxesMotion in_own_axes(double t) const override {
    const HandleMotion<double> handle = handle_motion(scene_, t);
    motion::OwnAxesMotion m;
    m.X.linear() = math::matrix(handle.R_WH, 0);
    m.X.translation() = math::vector(handle.p_W);
    m.v_W = math::vector(handle.v_W);
    m.a_W = math::vector(handle.a_W);
    m.w_B = math::vector(handle.w_H);
    m.alpha_B = math::vector(handle.alpha_H);
    return m;
  }
  motion::FrameForcing<math::Pack> forcing(const math::Pack& t, double gravity) const override {
    HandleMotion<math::Pack> handle;
    handle_motion(scene_, t, handle);
    handle.a_W.z += gravity;
    return {handle.R_WH, math::transposed(handle.R_WH, handle.v_W), handle.w_H, handle.alpha_H,
            math::transposed(handle.R_WH, handle.a_W)};
  }

 private:
  const Scenario& scene_;
};

/// The handle by the poses of a tracker that samples once an output interval.
class SampledHand {
 public:
  explicit SampledHand(const Scenario& scene) : scene_(scene) {
    for (; newest_ < 1; ++newest_) track_.push(handle_sample(scene, newest_ * scene.output_interval));
  }

  /// The segment of the step that starts at `t`; steps come in order. The tracker is a sample ahead of its end.
  const motion::FrameMotion& at(double t) {
    for (; (newest_ - 2) * scene_.output_interval < t + 1e-9; ++newest_) {
      track_.push(handle_sample(scene_, newest_ * scene_.output_interval));
      track_.forget_before(t);
    }
    return track_.segment(t + 1e-9);
  }

 private:
  const Scenario& scene_;
  motion::PoseTrack track_;
  int newest_ = -1;  ///< number of the next sample
};

/// One step that is thrown away: what an integrator derives from stiffness and mass is set up, as the peers' models
/// are.
void set_up(const Scenario& scene, const dynamics::HeldBody& body, double step, dynamics::Integrator& integrator) {
  dynamics::StrainState state = body.zero_state();
  integrator.step(body, FunctionHand(scene), 0.0, step, state);
}

template <typename Hand>
RunResult run_on(const Scenario& scene, const std::string& name, double step, Hand hand) {
  const dynamics::HeldBody body = held_body(scene);
  const std::unique_ptr<dynamics::Integrator> integrator =
      dynamics::make_integrator(validation::named<dynamics::IntegratorKind>(name, "benchmark", "integrator"));
  set_up(scene, body, scene.output_interval / steps_per_output(scene, step), *integrator);
  dynamics::StrainState state = body.zero_state();
  const motion::FrameMotion* motion = &hand.at(0.0);
  return stepping_loop(
      scene, step,
      [&](double t, double h) {
        motion = &hand.at(t);
        integrator->step(body, *motion, t, h, state);
      },
      [&](double t) -> Vector3d {
        const dynamics::HandleForcing handle = body.forcing(*motion, t);
        if (scene.kind != SceneKind::torsion) return body.object(handle, state).X.translation();
        return {0.0, 0.0, math::log_so3(handle.X_WH.linear()).z() + state.q[0]};
      });
}

/// The scene's outputs between the ends of steps, four at once.
class DenseOutputs {
 public:
  DenseOutputs(const Scenario& scene, const dynamics::HeldBody& body) : scene_(scene), shape_(body.shape()) {}

  void push(double t, const dynamics::StrainState& state) { strain_.push(t, state); }

  /// Appends those at the next of `times` [s, ascending] that are known; false where one is not bounded.
  bool append(const std::vector<double>& times, std::vector<Vector3d>& outputs) const {
    const double until = strain_.known_until() + 1e-9;
    std::size_t known = outputs.size();
    while (known < times.size() && times[known] < until) ++known;
    while (outputs.size() < known) {
      const std::size_t begin = outputs.size(), count = std::min<std::size_t>(math::pack_size, known - begin);
      math::Pack t;
      for (std::size_t i = 0; i < math::pack_size; ++i) t[i] = times[begin + std::min(i, count - 1)];
      math::Three<math::Pack> values;
      at(t, values);
      for (std::size_t i = 0; i < count; ++i) {
        outputs.push_back(math::vector(values, static_cast<int>(i)));
        if (!is_bounded(outputs.back())) return false;
      }
    }
    return true;
  }

 private:
  void at(const math::Pack& t, math::Three<math::Pack>& values) const {
    math::Pack q[rod::max_strain_coordinates]{};
    strain_.at(t, q);
    if (scene_.kind != SceneKind::six_dof) {
      values = math::none<math::Pack>();
      scalar_hand(scene_, t, values.z);
      values.z += q[0];
      return;
    }
    const math::Pack at_rest[rod::max_strain_coordinates]{};
    rod::TipOf<math::Pack> tip;
    shape_.tip(q, at_rest, tip);
    HandleMotion<math::Pack> handle;
    handle_motion(scene_, t, handle);
    values = handle.p_W + handle.R_WH * (tip.p_HE + tip.R_HE * math::three(scene_.p_EO));
  }

  const Scenario& scene_;
  const rod::ShapeModel& shape_;
  DenseStrain strain_;
};

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
  const dynamics::HeldBody body = held_body(scene);
  const std::unique_ptr<dynamics::Integrator> integrator =
      dynamics::make_integrator(validation::named<dynamics::IntegratorKind>(name, "benchmark", "integrator"));
  const std::vector<double> times = output_times(scene);
  const Start begin(scene, step);
  const FunctionHand hand(scene);
  set_up(scene, body, begin.step, *integrator);
  dynamics::StrainState state = body.zero_state();
  DenseOutputs dense(scene, body);
  RunResult result;
  result.outputs.reserve(times.size());
  const auto start = std::chrono::steady_clock::now();
  dense.push(0.0, state);
  for (double t = 0.0; result.outputs.size() < times.size();) {
    const double h = t < begin.duration - 1e-9 ? begin.step : step;
    integrator->step(body, hand, t, h, state);
    t += h;
    dense.push(t, state);
    if (!dense.append(times, result.outputs)) return result;
  }
  result.wall_seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  result.finite = true;
  return result;
}

class OurMethod : public Method {
 public:
  OurMethod(std::string integrator, bool samples)
      : integrator_(std::move(integrator)), samples_(samples), solves_(solves_the_equation_of_motion(integrator_)) {}

  std::string name() const override { return integrator_; }
  std::string hand() const override { return samples_ ? "samples" : "function"; }
  bool dense() const override { return !samples_; }
  /// A single spring is the same to all.
  bool has_scene_law(const Scenario& scene) const override { return solves_ || scene.kind != SceneKind::six_dof; }

  RunResult run(const Scenario& given, double step) const override {
    const Scenario scene = with_length_of_its_slopes(given);
    if (dense() && step > (1.0 + 1e-9) * scene.output_interval) return run_in_long_steps(scene, integrator_, step);
    if (samples_) return run_on(scene, integrator_, step, SampledHand(scene));
    return run_on(scene, integrator_, step, FunctionHand(scene));
  }

 private:
  std::string integrator_;
  bool samples_, solves_;
};

}  // namespace

bool solves_the_equation_of_motion(const std::string& integrator) {
  return dynamics::make_integrator(validation::named<dynamics::IntegratorKind>(integrator, "benchmark", "integrator"))
      ->solves_the_equation_of_motion();
}

std::vector<MethodPtr> our_methods() {
  std::vector<MethodPtr> methods;
  for (const std::string& name : validation::names<dynamics::IntegratorKind>()) {
    for (const bool samples : {false, true}) methods.push_back(std::make_unique<OurMethod>(name, samples));
  }
  return methods;
}

}  // namespace spring_workbench::benchmark
