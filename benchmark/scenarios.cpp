#include "benchmark/scenarios.h"

#include <cmath>

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
  const double omega = kTwoPi * frequency;
  const double s = std::sin(omega * t + phase);
  const double c = std::cos(omega * t + phase);
  return {amplitude * s, amplitude * omega * c, -amplitude * omega * omega * s};
}

ScalarMotion turn(int axis, double t) { return sine(kTurnAmplitude, kTurnFrequency[axis], kTurnPhase[axis], t); }

ScalarMotion lissajous(int axis, double t) {
  return sine(kLissajousAmplitude, kLissajousFrequency[axis], kLissajousPhase[axis], t);
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

ScalarMotion scalar_hand(const Scenario& scene, double t) {
  return scene.kind == SceneKind::stretch ? sine(kStretchAmplitude, kStretchFrequency, 0.0, t)
                                          : sine(kTorsionAmplitude, kTorsionFrequency, 0.0, t);
}

namespace {

/// What the hand of scene C does, by its sines.
struct Sines {
  explicit Sines(double t) : x{lissajous(0, t), lissajous(1, t), lissajous(2, t)}, a(turn(0, t)), b(turn(1, t)) {
    sa = std::sin(a.value), ca = std::cos(a.value), sb = std::sin(b.value), cb = std::cos(b.value);
  }
  ScalarMotion x[3], a, b;
  double sa, ca, sb, cb;
};

HandState state_of(const Sines& s) {
  HandState hand;
  hand.p_WT = Vector3d(s.x[0].value, s.x[1].value, s.x[2].value);
  hand.v_WT_W = Vector3d(s.x[0].rate, s.x[1].rate, s.x[2].rate);
  hand.R_WT << s.cb, 0.0, s.sb, s.sa * s.sb, s.ca, -s.sa * s.cb, -s.ca * s.sb, s.sa, s.ca * s.cb;
  hand.w_WT_T = Vector3d(s.a.rate * s.cb, s.b.rate, s.a.rate * s.sb);
  return hand;
}

HandAcceleration acceleration_of(const Sines& s) {
  HandAcceleration hand;
  hand.a_WT_W = Vector3d(s.x[0].acceleration, s.x[1].acceleration, s.x[2].acceleration);
  hand.alpha_WT_T = Vector3d(s.a.acceleration * s.cb - s.a.rate * s.b.rate * s.sb, s.b.acceleration,
                             s.a.acceleration * s.sb + s.a.rate * s.b.rate * s.cb);
  return hand;
}

/// The same of scenes A and B.
HandState state_of(const Scenario& scene, const ScalarMotion& x) {
  HandState hand;
  if (scene.kind == SceneKind::stretch) {
    hand.p_WT.z() = x.value;
    hand.v_WT_W.z() = x.rate;
  } else {
    hand.R_WT = Eigen::AngleAxisd(x.value, Vector3d::UnitZ()).toRotationMatrix();
    hand.w_WT_T.z() = x.rate;
  }
  return hand;
}

HandAcceleration acceleration_of(const Scenario& scene, const ScalarMotion& x) {
  HandAcceleration hand;
  (scene.kind == SceneKind::stretch ? hand.a_WT_W : hand.alpha_WT_T).z() = x.acceleration;
  return hand;
}

/// From T to H, `length` behind it along the fork's axis.
HandMotion moved_to_handle(double length, const HandMotion& of_T) {
  const Vector3d p_TH(0.0, 0.0, -length);
  const Vector3d& w = of_T.state.w_WT_T;
  const Matrix3d& R = of_T.state.R_WT;
  HandMotion of_H = of_T;
  of_H.state.p_WT += R * p_TH;
  of_H.state.v_WT_W += R * w.cross(p_TH);
  of_H.acceleration.a_WT_W += R * (of_T.acceleration.alpha_WT_T.cross(p_TH) + w.cross(w.cross(p_TH)));
  return of_H;
}

}  // namespace

HandState hand_state(const Scenario& scene, double t) {
  return scene.kind == SceneKind::six_dof ? state_of(Sines(t)) : state_of(scene, scalar_hand(scene, t));
}

HandAcceleration hand_acceleration(const Scenario& scene, double t) {
  return scene.kind == SceneKind::six_dof ? acceleration_of(Sines(t)) : acceleration_of(scene, scalar_hand(scene, t));
}

HandMotion handle_motion(const Scenario& scene, double t) {
  if (scene.kind == SceneKind::six_dof) {
    const Sines s(t);
    return moved_to_handle(scene.length, {state_of(s), acceleration_of(s)});
  }
  const ScalarMotion x = scalar_hand(scene, t);
  return moved_to_handle(scene.length, {state_of(scene, x), acceleration_of(scene, x)});
}

HandState handle_state(const Scenario& scene, double t) { return handle_motion(scene, t).state; }
HandAcceleration handle_acceleration(const Scenario& scene, double t) { return handle_motion(scene, t).acceleration; }

std::vector<double> output_times(const Scenario& scene) {
  const auto count = static_cast<std::size_t>(std::lround(scene.duration / scene.output_interval)) + 1;
  std::vector<double> times(count);
  for (std::size_t i = 0; i < count; ++i) times[i] = static_cast<double>(i) * scene.output_interval;
  return times;
}

int steps_per_output(const Scenario& scene, double step) {
  return static_cast<int>(std::ceil(scene.output_interval / step * (1.0 - 1e-9)));
}

double hand_amplitude(const Scenario& scene) {
  if (scene.kind == SceneKind::stretch) return kStretchAmplitude;
  return scene.kind == SceneKind::torsion ? kTorsionAmplitude : kLissajousAmplitude;
}

}  // namespace spring_workbench::benchmark
