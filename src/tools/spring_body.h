#pragma once

#include <utility>

#include "spring_workbench/bodies/free_body.h"
#include "spring_workbench/rod/settings.h"
#include "spring_workbench/tools/tool_hold.h"

namespace spring_workbench::tools {

/// The object on the tool `spring` (doc/model.md, "Tools"): a spring-damper between the hand and the centre of mass,
/// which the object is free to turn about. F = −(k (r − L) + c ṙ) n, with r n from the hand to the centre. Stepped by
/// an exponential midpoint rule of order two: the linear part in closed form, so that no stiffness limits it.
class SpringBody final : public ToolHold {
 public:
  /// Keeps a reference to `body`, whose mass must be > 0. `rest_length` [m] > 0; stiffness and damping of `stretch`.
  SpringBody(std::size_t index, const scene::Body& body, double gravity, const RigidTransform& X_WO, double rest_length,
             const rod::ForkSettings& fork);

  std::size_t index() const override { return state_.free.index(); }
  motion::MotionState object() const override { return state_.free.object(); }
  bool advance(double h, const Wrench& contact_W) override;
  void save(bodies::TrialStart& start) const override { start.keep(state_); }
  void restore(const bodies::TrialStart& start) override { state_ = start.kept<State>(); }
  Response response(double h) const override;
  Matrix6d mobility() const override { return state_.free.mobility(); }
  void add_impulse(const Wrench& impulse_W) override { state_.free.add_impulse(impulse_W); }
  void block(double h) override;
  bodies::Coupling coupling(double h, const RigidTransform& X_WO, const Matrix6d& mobility) const override;
  void follow(double h, const motion::MotionState& object, const Wrench& pull_W) override;

  void set_hand(const motion::MotionSegment& hand, double t) override;
  Wrench spring_pull() const override;
  void regrasp(const RigidTransform& X_WO, const Wrench& pull_W) override;
  void take_twist(const Twist& V_WO_W) override { state_.free.set_twist(V_WO_W); }
  void set_springs(const rod::ForkSettings& fork) override;
  rod::PerDof fitting_stiffness(const rod::ForkSettings& fork, double gravity, const ObjectGoal& goal) const override;
  bool set_dofs(const rod::ForkDofs&, double) override { return false; }
  void set_step_control(const dynamics::DynamicsSettings&) override {}  // it has a rule of its own
  bool sleeps(double, bool) override { return false; }
  void let_pass(double h) override { state_.t += h; }
  int coordinates() const override { return 1; }
  double length() const override { return rest_length_; }
  double elastic_energy() const override;
  double energy_added() const override { return 0.0; }
  StepEstimates take_estimates() override { return std::exchange(estimates_, {}); }
  void describe(bool massless, ToolState& state) const override;
  void exchange(math::StateArchive& state) override {
    state(rest_length_, k_, c_, hand_, state_.t, state_.free, estimates_);
  }

 private:
  struct State {
    double t;
    bodies::FreeBody free;  ///< pose and momentum; its own motion is used for the rotation alone
  };
  /// From the hand to the object's centre, world axes, and its rate.
  struct Span {
    Vector3d d, rate;
  };
  /// The linear part frozen about a span: radial and transverse oscillators.
  struct Linear {
    Vector3d d, n;
    double radial = 0.0, alpha = 0.0, transverse = 0.0;  ///< ω² [1/s²], c / 2m [1/s], ω² [1/s²]
  };
  Span span() const;
  Linear linear(const Span& s) const;
  Vector3d acceleration(const Span& s, const Vector3d& rest_W) const;
  Vector3d nonlinear_residual(const Linear& a, const Span& s, const Vector3d& rest_W) const;
  static Span respond(const Linear& a, const Span& s, double h, const Vector3d& nonlinear_residual);

  double mass_, gravity_, rest_length_;
  double k_ = 0.0, c_ = 0.0;
  motion::MotionSegment hand_;
  State state_;
  Matrix3d inertia_O_;
  StepEstimates estimates_;
};

}  // namespace spring_workbench::tools
