#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "spring_workbench/math/rigid_transform.h"

namespace spring_workbench::benchmark {

/// The drag scene: a box lies flat on the plane z = 0, held at its centre by six springs and dampers. The hand presses
/// it 0.1 m below the plane and drags it 0.5 m along x at constant speed. The box lags behind by μ (k 0.1 m + m g) / k.
struct DragScene {
  double stiffness_factor = 1.0;
  bool turns = true;  ///< false: the box cannot turn, which is easier because contact cannot rock it

  double mass = 5.0;                                                    ///< [kg]
  Vector3d size{0.2, 0.1, 0.05};                                        ///< [m]
  double friction = 0.5, gravity = 9.81;                                ///< –, [m/s²]
  double stiffness() const { return 2000.0 * stiffness_factor; }        ///< translational, in every direction [N/m]
  double turning_stiffness() const { return 20.0 * stiffness_factor; }  ///< rotational, in every direction [N·m/rad]
  double damping() const;                                               ///< critical [N·s/m]
  double turning_damping() const;                                       ///< [N·m·s/rad]; critical about z
  Vector3d inertia() const;                                             ///< about the principal axes [kg m²]
  double exact_lag() const;                                             ///< [m]
};

/// Position that the hand prescribes for the box's centre, with velocity and acceleration.
struct DragHand {
  Vector3d p_W, v_W, a_W;  ///< [m], [m/s], [m/s²]
};
constexpr double drag_duration = 6.0;  ///< [s]
DragHand drag_hand(const DragScene& scene, double t);

/// A simulation of the scene.
class DragWorld {
 public:
  virtual ~DragWorld() = default;
  /// Takes a step of `h` [s] from time `t` [s].
  virtual void step(double t, double h) = 0;
  virtual RigidTransform box() const = 0;
};

/// A method that simulates the scene; `make` is given the step [s].
struct DragMethod {
  std::string name;
  bool can_lock_turning = false;  ///< whether `DragScene::turns` may be false
  std::function<std::unique_ptr<DragWorld>(const DragScene&, double step)> make;
};

struct DragRow {
  std::string method;
  double stiffness_factor = 1.0;
  bool turns = true;
  double step = 0.0;  ///< [s]
  bool finite = false;
  double lag = 0.0;          ///< lag at the end [m]
  double lag_error = 0.0;    ///< relative error of the lag
  double penetration = 0.0;  ///< largest penetration of a corner over all steps [m]
  double cpu_us_per_simulated_second = 0.0;
  double cpu_us_per_step = 0.0;
};
template <typename Fields>
void each_field(DragRow& r, Fields& fields) {
  fields(r.method, r.stiffness_factor, r.turns, r.step, r.finite, r.lag, r.lag_error, r.penetration,
         r.cpu_us_per_simulated_second, r.cpu_us_per_step);
}
/// Runs a method. The processor time is the minimum over `runs` runs and covers the steps only.
DragRow run_drag(const DragMethod& method, const DragScene& scene, double step, int runs);

/// Our contact, through Simulation: mode `stop` on the bench, `dynamic` on a movable slab (on the bench it would equal
/// `stop`); with the shape `bushing` and hand samples at 50 Hz.
std::vector<DragMethod> our_drags();
/// The engines, coupled as a competent user would.
std::vector<DragMethod> bullet_drags();
std::vector<DragMethod> mujoco_drags();
std::vector<DragMethod> ode_drags();
std::vector<DragMethod> dart_drags();

}  // namespace spring_workbench::benchmark
