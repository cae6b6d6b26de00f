#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "benchmark/held_body.h"
#include "benchmark/simulated_rod.h"

namespace spring_workbench::benchmark {

/// The law of the rod as a user of a physics engine adds it: force [N] and moment [N·m] on a free body at its centre of
/// mass, world axes, by the pose and velocity that the body and the hand have. Since engines know no rod, it comes from
/// the library: the inverse kinematics of the shape model, which starts at the strain of the last call moved on by its
/// rate, then springs and dampers.
class RodForce {
 public:
  /// Of what moment of an engine's step the force is. In steps of semi-implicit Euler a velocity is the mean over a
  /// step, so the hand's is that of the poses at the ends of the same step (which Bullet makes for its bodies, too).
  enum class When {
    start_of_step,  ///< An explicit force. At long steps the engine is unstable.
    each_stage,     ///< The same in a Runge–Kutta method, with the hand's own velocity.
    /// That of the end, as far as a step of semi-implicit Euler and a linearisation of the law predict them: stable PD
    /// control (Tan, Liu and Turk, Stable proportional-derivative controllers, IEEE Computer Graphics and Applications
    /// 31(4), 2011), which users of these engines have for stiff springs that are forces. No engine takes a stiffness
    /// of 6 × 6 itself: Bullet's and ODE's constraints have one for each axis, DART's joints one for each coordinate,
    /// and MuJoCo's `implicit` integrators do not know the derivatives of a user's force (its issue 2433).
    end_of_step
  };

  /// `one` has all degrees of freedom on, and a shape model with six coordinates (can_push()).
  RodForce(const RodCase& one, const std::string& shape, When when);
  static bool can_push(const RodCase& one, const std::string& shape);

  /// The body at t = 0, without strain.
  FreeBody body() const;
  /// The load for a step of `h` [s] from `t` [s]. `body`: its state at t.
  Wrench load(double t, double h, const BodyState& body);
  /// Whether the rod did not reach the tip, once. There is no law for that, and from then on no load.
  bool lost() const { return lost_; }

 private:
  void move_hand(double t);

  dynamics::HeldBody held_;
  Matrix6d stiffness_, damping_;
  SampledHand samples_;
  When when_;
  double t_ = 0.0;                                            ///< time of the last load [s]
  motion::BodyRateState hand_;                                ///< the hand then
  Vector6d q_ = Vector6d::Zero(), q_dot_ = Vector6d::Zero();  ///< the strain then, and its rate
  bool lost_ = false;
};

/// A free body in an engine.
class BodyEngine {
 public:
  virtual ~BodyEngine() = default;
  /// Takes a step of `h` [s] from time `t` [s].
  virtual void step(double t, double h) = 0;
  /// Not finite if the engine has given up.
  virtual BodyState state() const = 0;
};

/// The load on a body, as RodForce::load().
using LoadLaw = std::function<Wrench(double t, double h, const BodyState& body)>;

/// An engine that is given the rod's law.
struct RodEngine {
  std::string name;
  RodForce::When when = RodForce::When::start_of_step;
  std::function<std::unique_ptr<BodyEngine>(const FreeBody& body, LoadLaw load)> make;
};

/// Runs a case in an engine, in equal steps of at most `step` [s] between the times at which one must end
/// (step_ends()). The timed loop contains the steps with the law and the poses at the outputs. Not finite if the body
/// escapes or the rod does not reach it.
RodRun run_engine(const RodCase& one, const std::string& shape, const RodEngine& engine, double step);

}  // namespace spring_workbench::benchmark
