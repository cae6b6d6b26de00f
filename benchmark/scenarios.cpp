#include "benchmark/scenarios.h"

#include <cmath>

#include "spring_workbench/math/so3.h"

namespace spring_workbench::benchmark {
namespace {

constexpr double kTwoPi = 6.283185307179586476925286766559;

constexpr double kStretchAmplitude = 0.1;     // m
constexpr double kStretchFrequency = 1.0;     // Hz
constexpr double kTorsionAmplitude = 0.8;     // rad
constexpr double kTorsionFrequency = 1.5;     // Hz
constexpr double kNominalStiffness = 1e4;     // N/m and N·m/rad, of A and B
constexpr double kLissajousAmplitude = 0.15;  // m
constexpr double kLissajousFrequency[3] = {1.0, 1.3, 1.7};
constexpr double kLissajousPhase[3] = {0.0, 1.0, 2.0};
constexpr double kTurnAmplitude = 0.6;  // rad
constexpr double kTurnFrequency[2] = {1.1, 1.4};
constexpr double kTurnPhase[2] = {0.0, 1.0};

ScalarMotion sine(double amplitude, double frequency, double phase, double t) {
  const double omega = kTwoPi * frequency, angle = omega * t + phase, s = std::sin(angle);
  return {amplitude * s, amplitude * omega * std::cos(angle), -amplitude * omega * omega * s};
}

/// A cube of 10 kg with 0.05 kg m² about every axis, held at its centre.
Scenario cube_scene(double damping_ratio) {
  Scenario scene;
  scene.mass = 10.0;
  scene.inertia = Vector3d::Constant(0.05);
  scene.damping_ratio = damping_ratio;
  return scene;
}

void set_single_spring(double k, Scenario& scene) {
  const int i = scene.single_coordinate();
  scene.stiffness[i] = k;
  scene.damping[i] = 2.0 * scene.damping_ratio * std::sqrt(scene.single_inertia() * k);
  scene.stiffness_factor = k / kNominalStiffness;
}

}  // namespace

ScalarMotion from_rest(double t, double ramp) {
  if (ramp <= 0.0 || t >= ramp) return {t - 0.5 * ramp, 1.0, 0.0};
  const double u = t / ramp;
  return {ramp * u * u * u * (1.0 - 0.5 * u), u * u * (3.0 - 2.0 * u), 6.0 * u * (1.0 - u) / ramp};
}

Scenario stretch_scene(double k, double damping_ratio, double mass) {
  Scenario scene = cube_scene(damping_ratio);
  scene.inertia *= mass / scene.mass;
  scene.mass = mass;
  scene.name = "A";
  scene.kind = SceneKind::stretch;
  set_single_spring(k, scene);
  return scene;
}

Scenario torsion_scene(double k, double damping_ratio) {
  Scenario scene = cube_scene(damping_ratio);
  scene.name = "B";
  scene.kind = SceneKind::torsion;
  set_single_spring(k, scene);
  return scene;
}

Scenario six_dof_scene(double stiffness_factor, double damping_ratio, double mass) {
  const Vector3d size(0.2, 0.1, 0.05);
  const double k_bend = 2000.0 * stiffness_factor;
  const double k_stretch = 5000.0 * stiffness_factor;
  const double k_rotation = 20.0 * stiffness_factor;
  Scenario scene;
  scene.name = "C";
  scene.kind = SceneKind::six_dof;
  scene.stiffness_factor = stiffness_factor;
  scene.mass = mass;
  const Vector3d squares = size.cwiseAbs2();
  scene.inertia = scene.mass / 12.0 * (Vector3d::Constant(squares.sum()) - squares);
  scene.p_EO = Vector3d(0.08, 0.0, 0.0);
  scene.damping_ratio = damping_ratio;
  scene.stiffness << k_bend, k_bend, k_stretch, k_rotation, k_rotation, k_rotation;
  const double axial_inertia = scene.inertia.z() + scene.mass * scene.p_EO.head<2>().squaredNorm();
  const double c_bend = 2.0 * damping_ratio * std::sqrt(scene.mass * k_bend);
  const double c_stretch = 2.0 * damping_ratio * std::sqrt(scene.mass * k_stretch);
  const double c_slope = c_bend / k_bend * k_rotation;
  const double c_torsion = 2.0 * damping_ratio * std::sqrt(axial_inertia * k_rotation);
  scene.damping << c_bend, c_bend, c_stretch, c_slope, c_slope, c_torsion;
  return scene;
}

namespace {

ScalarMotion scalar_motion(const Scenario& scene, double t) {
  const ScalarMotion s = from_rest(t, scene.ramp);
  const ScalarMotion x = scene.kind == SceneKind::stretch ? sine(kStretchAmplitude, kStretchFrequency, 0.0, s.value)
                                                          : sine(kTorsionAmplitude, kTorsionFrequency, 0.0, s.value);
  return {x.value, x.rate * s.rate, x.acceleration * s.rate * s.rate + x.rate * s.acceleration};
}

HandMotion tip_on_lissajous(double t) {
  HandMotion m;
  for (int i = 0; i < 3; ++i) {
    const ScalarMotion way = sine(kLissajousAmplitude, kLissajousFrequency[i], kLissajousPhase[i], t);
    m.state.p_WT[i] = way.value;
    m.state.v_WT_W[i] = way.rate;
    m.acceleration.a_WT_W[i] = way.acceleration;
  }
  const ScalarMotion a = sine(kTurnAmplitude, kTurnFrequency[0], kTurnPhase[0], t);
  const ScalarMotion b = sine(kTurnAmplitude, kTurnFrequency[1], kTurnPhase[1], t);
  const double sa = std::sin(a.value), ca = std::cos(a.value), sb = std::sin(b.value), cb = std::cos(b.value);
  m.state.R_WT << cb, 0.0, sb, sa * sb, ca, -sa * cb, -ca * sb, sa, ca * cb;
  m.state.w_WT_T << a.rate * cb, b.rate, a.rate * sb;
  m.acceleration.alpha_WT_T << a.acceleration * cb - a.rate * b.rate * sb, b.acceleration,
      a.acceleration * sb + a.rate * b.rate * cb;
  return m;
}

HandMotion tip_on_sine(const Scenario& scene, double t) {
  const ScalarMotion x = scalar_motion(scene, t);
  HandMotion m;
  if (scene.kind == SceneKind::stretch) {
    m.state.p_WT.z() = x.value;
    m.state.v_WT_W.z() = x.rate;
    m.acceleration.a_WT_W.z() = x.acceleration;
  } else {
    m.state.R_WT = Eigen::AngleAxisd(x.value, Vector3d::UnitZ()).toRotationMatrix();
    m.state.w_WT_T.z() = x.rate;
    m.acceleration.alpha_WT_T.z() = x.acceleration;
  }
  return m;
}

HandMotion as_hand(const motion::BodyRateState& m) {
  return {{m.X.linear(), m.X.translation(), m.v_W, m.w_B}, {m.a_W, m.alpha_B}};
}

}  // namespace

ScalarMotion scalar_hand(const Scenario& scene, double t) {
  if (!scene.samples) return scalar_motion(scene, t);
  const motion::BodyRateState m = scene.samples->tip(t).body_rate_state(t);
  if (scene.kind == SceneKind::stretch) return {m.X.translation().z(), m.v_W.z(), m.a_W.z()};
  return {math::log_so3(m.X.linear()).z(), m.w_B.z(), m.alpha_B.z()};
}

HandMotion hand_motion(const Scenario& scene, double t) {
  if (scene.samples) return as_hand(scene.samples->tip(t).body_rate_state(t));
  if (scene.kind != SceneKind::six_dof) return tip_on_sine(scene, t);
  const ScalarMotion s = from_rest(t, scene.ramp);
  HandMotion m = tip_on_lissajous(s.value);
  m.acceleration.a_WT_W = m.acceleration.a_WT_W * s.rate * s.rate + m.state.v_WT_W * s.acceleration;
  m.acceleration.alpha_WT_T = m.acceleration.alpha_WT_T * s.rate * s.rate + m.state.w_WT_T * s.acceleration;
  m.state.v_WT_W *= s.rate;
  m.state.w_WT_T *= s.rate;
  return m;
}

HandMotion handle_motion(const Scenario& scene, double t) {
  if (scene.samples) return as_hand(scene.samples->handle(t).body_rate_state(t));
  HandMotion m = hand_motion(scene, t);
  const Matrix3d& R = m.state.R_WT;
  const Vector3d &w = m.state.w_WT_T, p_TH = -scene.length * Vector3d::UnitZ(), v = w.cross(p_TH);
  m.state.p_WT += R * p_TH;
  m.state.v_WT_W += R * v;
  m.acceleration.a_WT_W += R * (m.acceleration.alpha_WT_T.cross(p_TH) + w.cross(v));
  return m;
}

HandState hand_state(const Scenario& scene, double t) { return hand_motion(scene, t).state; }
HandState handle_state(const Scenario& scene, double t) { return handle_motion(scene, t).state; }

Scenario with_sampled_hand(Scenario scene) {
  scene.samples.reset();
  scene.ramp = kRamp;
  std::vector<motion::PoseSample> poses;
  constexpr int beyond = 2;  // so that the last interval has its velocities
  for (std::size_t i = 0; i < output_times(scene).size() + beyond; ++i) {
    const double t = static_cast<double>(i) * scene.output_interval;
    const HandState handle = handle_state(scene, t);
    poses.push_back({t, make_transform(handle.p_WT, Quaterniond(handle.R_WT))});
  }
  scene.samples = std::make_shared<const SampledHand>(std::move(poses), scene.length);
  return scene;
}

std::vector<double> output_times(const Scenario& scene) {
  const auto count = static_cast<std::size_t>(std::lround(scene.duration / scene.output_interval)) + 1;
  std::vector<double> times(count);
  for (std::size_t i = 0; i < count; ++i) times[i] = static_cast<double>(i) * scene.output_interval;
  return times;
}

int steps_per_output(const Scenario& scene, double step) {
  return static_cast<int>(std::ceil(scene.output_interval / step * (1.0 - 1e-9)));
}

double step_length(const Scenario& scene, double step) {
  return step > scene.output_interval ? step : scene.output_interval / steps_per_output(scene, step);
}

double hand_amplitude(const Scenario& scene) {
  if (scene.kind == SceneKind::stretch) return kStretchAmplitude;
  return scene.kind == SceneKind::torsion ? kTorsionAmplitude : kLissajousAmplitude;
}

}  // namespace spring_workbench::benchmark
