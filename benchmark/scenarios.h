#pragma once

#include <cmath>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include "benchmark/sampled_hand.h"

namespace spring_workbench::benchmark {

using Vector6d = Eigen::Matrix<double, 6, 1>;

enum class SceneKind {
  stretch,  ///< A: one coordinate, the extension along the fork's axis
  torsion,  ///< B: one coordinate, the twist about the fork's axis
  six_dof   ///< C: all six coordinates of the bushing
};

/// A body held by the `bushing` of doc/model.md, on a hand that moves as an analytic function of time.
///
/// Frames: `W` world, z up; `T` the tip's rest frame, which the hand carries (the handle frame H moved by `length`
/// along its z axis); `E` the tip, inserted in the object; `O` the object's centre of mass, with the axes of E and of
/// the inertia tensor. Coordinates `q = (d, φ)`: E has the pose `p = d`, `R = exp(φ)` in T.
///
/// Law: `U = ½ Σ stiffness_i q_i²`, viscous generalised force `−damping_i q̇_i` (on the extension, not on the absolute
/// velocity), gravity along −z of W. Damping is that of doc/model.md with ζ per DOF: `c_stretch = 2 ζ √(m k_stretch)`,
/// `c_bend = 2 ζ √(m k_bend)`, on the slopes `(c_bend / k_bend) k_slope`, `c_torsion = 2 ζ √(I_a k_torsion)`, `I_a` the
/// moment of inertia about the fork's axis through the grasp. Start: zero strain and zero strain rate, so the object
/// moves with the hand at t = 0.
struct Scenario {
  std::string name;  ///< "A", "B" or "C"
  SceneKind kind = SceneKind::six_dof;
  double stiffness_factor = 1.0;        ///< relative to the scene's nominal stiffness (A: 1e4 N/m, B: 1e4 N·m/rad)
  double mass = 1.0;                    ///< [kg]
  Vector3d inertia = Vector3d::Ones();  ///< principal, about and in O [kg m²]
  Vector3d p_EO = Vector3d::Zero();     ///< position of the centre of mass relative to the tip [m]
  double length =
      0.2;  ///< length L of the fork [m], which determines H; the motion of a known hand does not depend on it
  double damping_ratio = 1.0;             ///< ζ of every DOF
  Vector6d stiffness = Vector6d::Zero();  ///< of dx, dy, dz [N/m], φx, φy, φz [N·m/rad]; unused ones are 0
  Vector6d damping = Vector6d::Zero();    ///< of dx, dy, dz [N·s/m], φx, φy, φz [N·m·s/rad]
  double gravity = 9.81;                  ///< [m/s²]
  double duration = 4.0;                  ///< [s]
  double output_interval = 0.02;          ///< [s]; outputs at 0, 0.02, …, duration
  double settled_after = 0.1;             ///< errors are measured after this time [s]
  double ramp = 0.0;  ///< [s] in which the hand gets to its speed from rest; 0: it has it from the start on
  /// The poses of a tracker and the motion through them, if the hand is known only by these; null if it is a function
  /// of time.
  std::shared_ptr<const SampledHand> samples;

  /// The one coordinate of scenes A and B as an index of q: 2 or 5.
  int single_coordinate() const { return kind == SceneKind::stretch ? 2 : 5; }
  /// Mass or moment of inertia for the one coordinate of scenes A and B [kg, kg m²].
  double single_inertia() const { return kind == SceneKind::stretch ? mass : inertia.z(); }
};

/// A coordinate with two derivatives.
struct ScalarMotion {
  double value = 0.0, rate = 0.0, acceleration = 0.0;
};

/// Time along the path of a hand that starts at rest and has its full speed after `ramp` [s]: twice continuously
/// differentiable.
ScalarMotion from_rest(double t, double ramp);

/// [s]; the ramp of hands that are known by samples. A hand that grasps hardly moves, and the velocity at the first
/// sample is that of a chord, which is far off if the hand moves already.
constexpr double kRamp = 0.5;

/// Scene A: 10 kg, or another mass, on a vertical spring-damper of stiffness `k` [N/m]; the hand at z = 0.1 sin(2π t).
Scenario stretch_scene(double k, double damping_ratio = 1.0, double mass = 10.0);

/// Scene B: 0.05 kg m² on a torsion spring-damper of stiffness `k` [N·m/rad]; hand twist 0.8 sin(2π 1.5 t) rad.
Scenario torsion_scene(double k, double damping_ratio = 1.0);

/// Scene C: a 5 kg box 0.2 × 0.1 × 0.05 m gripped so that its centre is 0.08 m along its long axis from the tip;
/// k = 2000, 2000, 5000 N/m and 20 N·m/rad on all three rotations, times `stiffness_factor`. Hand: position
/// 0.15 sin(2π f t + ψ) m with f = 1, 1.3, 1.7 Hz and ψ = 0, 1, 2 rad along x, y, z; rotation Rx(α) Ry(β) with
/// α = 0.6 sin(2π 1.1 t), β = 0.6 sin(2π 1.4 t + 1) rad.
/// The box may have another mass.
Scenario six_dof_scene(double stiffness_factor, double damping_ratio = 1.0, double mass = 5.0);

/// The same scene with a hand that starts from rest (kRamp) and is known only by the poses of a tracker, one per output
/// interval. All methods get the C¹ motion through them, with the velocities computed by the library.
Scenario with_sampled_hand(Scenario scene);

/// Pose and velocity of the tip's rest frame T.
struct HandState {
  Matrix3d R_WT = Matrix3d::Identity();
  Vector3d p_WT = Vector3d::Zero();
  Vector3d v_WT_W = Vector3d::Zero();  ///< [m/s]
  Vector3d w_WT_T = Vector3d::Zero();  ///< angular velocity in T's axes [rad/s]
};

/// Acceleration of T.
struct HandAcceleration {
  Vector3d a_WT_W = Vector3d::Zero();      ///< of its origin [m/s²]
  Vector3d alpha_WT_T = Vector3d::Zero();  ///< angular, in T's axes [rad/s²]
};

/// The motion of T at one time.
struct HandMotion {
  HandState state;
  HandAcceleration acceleration;
};

HandState hand_state(const Scenario& scene, double t);
HandMotion hand_motion(const Scenario& scene, double t);

/// The same for the handle frame H, `length` behind T along the fork's axis.
HandState handle_state(const Scenario& scene, double t);
HandMotion handle_motion(const Scenario& scene, double t);

/// The one moving coordinate of the hand in scenes A and B: height [m] or twist [rad].
ScalarMotion scalar_hand(const Scenario& scene, double t);

/// Caches the result of `of` for a scene's hand at the last time [s], because several stages of a step, and all
/// differences of a Jacobian, use the same time.
template <typename Motion, Motion (*of)(const Scenario&, double)>
class Remembered {
 public:
  const Motion& at(const Scenario& scene, double t) {
    constexpr double same_time = 1e-13;  // s; the end of a step and the start of the next one differ by rounding
    if (!(std::abs(t - t_) < same_time)) {
      motion_ = of(scene, t);
      t_ = t;
    }
    return motion_;
  }

 private:
  double t_ = std::numeric_limits<double>::quiet_NaN();
  Motion motion_;
};
using RememberedState = Remembered<HandState, &hand_state>;
using RememberedMotion = Remembered<HandMotion, &hand_motion>;
using RememberedScalar = Remembered<ScalarMotion, &scalar_hand>;

/// Output times: 0, output_interval, …, duration.
std::vector<double> output_times(const Scenario& scene);

/// Number of equal steps in an output interval for a largest step of `step` [s].
int steps_per_output(const Scenario& scene, double step);

/// Step length of a run with steps of at most `step` [s]: a divisor of the output interval, or `step` if that is
/// longer.
double step_length(const Scenario& scene, double step);

/// The amplitude of the hand, to which errors are relative: 0.1 m, 0.8 rad or 0.15 m.
double hand_amplitude(const Scenario& scene);

}  // namespace spring_workbench::benchmark
