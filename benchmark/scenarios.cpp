#include "benchmark/scenarios.h"

#include <cmath>

#include "benchmark/sine_and_cosine.h"
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

template <typename S>
SPRING_WORKBENCH_INLINE ScalarMotionOf<S> sine(double amplitude, double frequency, double phase, const S& t) {
  const double omega = kTwoPi * frequency;
  const SineAndCosine<S> of = sine_and_cosine(S(omega * t + phase));
  return {amplitude * of.sine, amplitude * omega * of.cosine, -amplitude * omega * omega * of.sine};
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

template <typename S>
SPRING_WORKBENCH_INLINE ScalarMotionOf<S> scalar_motion(const Scenario& scene, const S& t) {
  return scene.kind == SceneKind::stretch ? sine(kStretchAmplitude, kStretchFrequency, 0.0, t)
                                          : sine(kTorsionAmplitude, kTorsionFrequency, 0.0, t);
}

/// Of the tip's rest frame T in scene C, the names of HandleMotion standing for T.
template <typename S>
SPRING_WORKBENCH_INLINE HandleMotion<S> tip_on_lissajous(const S& t) {
  const auto way = [&t](int i) { return sine(kLissajousAmplitude, kLissajousFrequency[i], kLissajousPhase[i], t); };
  const auto turn = [&t](int i) { return sine(kTurnAmplitude, kTurnFrequency[i], kTurnPhase[i], t); };
  const ScalarMotionOf<S> x = way(0), y = way(1), z = way(2), a = turn(0), b = turn(1);
  const auto [sa, ca] = sine_and_cosine(a.value);
  const auto [sb, cb] = sine_and_cosine(b.value);
  HandleMotion<S> m;
  m.R_WH = {{cb, sa * sb, -ca * sb}, {S{}, ca, sa}, {sb, -sa * cb, ca * cb}};
  m.p_W = {x.value, y.value, z.value};
  m.v_W = {x.rate, y.rate, z.rate};
  m.a_W = {x.acceleration, y.acceleration, z.acceleration};
  m.w_H = {a.rate * cb, b.rate, a.rate * sb};
  m.alpha_H = {a.acceleration * cb - a.rate * b.rate * sb, b.acceleration, a.acceleration * sb + a.rate * b.rate * cb};
  return m;
}

/// The same in scenes A and B.
template <typename S>
SPRING_WORKBENCH_INLINE HandleMotion<S> tip_on_sine(const Scenario& scene, const S& t) {
  const ScalarMotionOf<S> x = scalar_motion(scene, t);
  const S zero{}, one = zero + 1.0;
  HandleMotion<S> m{};
  if (scene.kind == SceneKind::stretch) {
    m.R_WH = {{one, zero, zero}, {zero, one, zero}, {zero, zero, one}};
    m.p_W.z = x.value;
    m.v_W.z = x.rate;
    m.a_W.z = x.acceleration;
  } else {
    const auto [s, c] = sine_and_cosine(x.value);
    m.R_WH = {{c, s, zero}, {-s, c, zero}, {zero, zero, one}};
    m.w_H.z = x.rate;
    m.alpha_H.z = x.acceleration;
  }
  return m;
}

template <typename S>
SPRING_WORKBENCH_INLINE HandleMotion<S> tip_motion(const Scenario& scene, const S& t) {
  return scene.kind == SceneKind::six_dof ? tip_on_lissajous(t) : tip_on_sine(scene, t);
}

template <typename S>
SPRING_WORKBENCH_INLINE HandleMotion<S> motion_of_handle(const Scenario& scene, const S& t) {
  HandleMotion<S> m = tip_motion(scene, t);
  m.p_W = m.p_W - scene.length * m.R_WH.z;
  if (scene.kind != SceneKind::six_dof) return m;  // it turns about the fork's axis at most
  const math::Three<S> p_TH{S{}, S{}, S{} - scene.length}, v = math::cross(m.w_H, p_TH);
  m.v_W += m.R_WH * v;
  m.a_W += m.R_WH * (math::cross(m.alpha_H, p_TH) + math::cross(m.w_H, v));
  return m;
}

SPRING_WORKBENCH_INLINE HandState state(const HandleMotion<double>& m) {
  return {math::matrix(m.R_WH, 0), math::vector(m.p_W), math::vector(m.v_W), math::vector(m.w_H)};
}
SPRING_WORKBENCH_INLINE HandAcceleration acceleration(const HandleMotion<double>& m) {
  return {math::vector(m.a_W), math::vector(m.alpha_H)};
}

}  // namespace

namespace {

HandState state(const motion::OwnAxesMotion& m) { return {m.X.linear(), m.X.translation(), m.v_W, m.w_B}; }

}  // namespace

ScalarMotion scalar_hand(const Scenario& scene, double t) {
  if (!scene.samples) return scalar_motion(scene, t);
  const motion::OwnAxesMotion m = scene.samples->tip(t).in_own_axes(t);
  if (scene.kind == SceneKind::stretch) return {m.X.translation().z(), m.v_W.z(), m.a_W.z()};
  return {math::log_so3(m.X.linear()).z(), m.w_B.z(), m.alpha_B.z()};
}

HandState hand_state(const Scenario& scene, double t) {
  return scene.samples ? state(scene.samples->tip(t).in_own_axes(t)) : state(tip_motion(scene, t));
}
HandAcceleration hand_acceleration(const Scenario& scene, double t) {
  if (!scene.samples) return acceleration(tip_motion(scene, t));
  const motion::OwnAxesMotion m = scene.samples->tip(t).in_own_axes(t);
  return {m.a_W, m.alpha_B};
}
HandState handle_state(const Scenario& scene, double t) {
  return scene.samples ? state(scene.samples->handle(t).in_own_axes(t)) : state(motion_of_handle(scene, t));
}
HandAcceleration handle_acceleration(const Scenario& scene, double t) {
  if (!scene.samples) return acceleration(motion_of_handle(scene, t));
  const motion::OwnAxesMotion m = scene.samples->handle(t).in_own_axes(t);
  return {m.a_W, m.alpha_B};
}
HandleMotion<double> handle_motion(const Scenario& scene, double t) { return motion_of_handle(scene, t); }
SPRING_WORKBENCH_WIDE void handle_motion(const Scenario& scene, const math::Pack& t, HandleMotion<math::Pack>& out) {
  out = motion_of_handle(scene, t);
}

Scenario with_sampled_hand(Scenario scene) {
  scene.samples.reset();
  std::vector<motion::PoseSample> poses;
  constexpr int beyond = 2;  // so that the last interval has its velocities
  for (std::size_t i = 0; i < output_times(scene).size() + beyond; ++i) {
    const double t = static_cast<double>(i) * scene.output_interval;
    const HandState handle = handle_state(scene, t);
    poses.push_back({t, make_transform(Quaterniond(handle.R_WT), handle.p_WT)});
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
