#pragma once

#include "spring_workbench/dynamics/integrator.h"

namespace spring_workbench::dynamics {

/// Keeps the acceleration at the end of a step for the start of the next, if nothing has changed in between.
class LastAcceleration {
 public:
  rod::StrainVector get(const HeldBody& body, const HandleForcing& handle, const StrainState& state);
  void keep(const HeldBody& body, const HandleForcing& handle, const StrainState& state,
            const rod::StrainVector& q_ddot);
  void exchange(math::StateArchive& state) {
    state(version_, load_version_, t_, handle_acceleration_, handle_angular_acceleration_, state_, q_ddot_);
  }

 private:
  long version_ = -1, load_version_ = -1;
  double t_ = 0.0;
  Vector3d handle_acceleration_ = Vector3d::Zero(), handle_angular_acceleration_ = Vector3d::Zero();
  StrainState state_;
  rod::StrainVector q_ddot_;
};

/// Semi-implicit Euler, as in game engines: q̇ += h q̈(q, q̇), q += h q̇. First order; unstable for ω h > 2, with
/// damping for less.
class SemiImplicitEuler final : public Integrator {
 public:
  int order() const override { return 1; }
  StepEstimate step(const HeldBody& body, const motion::FrameMotion& handle, double t, double h,
                    StrainState& state) override;
  void exchange(math::StateArchive& state) override { state(last_); }

 private:
  LastAcceleration last_;
};

/// The classical Runge–Kutta method of order four. Unstable for ω h > 2.8.
class RungeKutta4 final : public Integrator {
 public:
  int order() const override { return 4; }
  StepEstimate step(const HeldBody& body, const motion::FrameMotion& handle, double t, double h,
                    StrainState& state) override;
  void exchange(math::StateArchive& state) override { state(last_); }

 private:
  LastAcceleration last_;
};

}  // namespace spring_workbench::dynamics
