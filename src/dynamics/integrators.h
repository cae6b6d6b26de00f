#pragma once

#include <complex>

#include "spring_workbench/dynamics/integrator.h"

namespace spring_workbench {

/// Keeps the acceleration at the end of a step for the start of the next, where nothing has changed between.
class LastAcceleration {
 public:
  StrainVector get(const HeldBody& body, const HandleForcing& handle, const StrainState& state);
  void keep(const HeldBody& body, const HandleForcing& handle, const StrainState& state, const StrainVector& q_ddot);

 private:
  long version_ = -1, load_version_ = -1;
  double t_ = 0.0;
  Vector3d handle_acceleration_ = Vector3d::Zero(), handle_angular_acceleration_ = Vector3d::Zero();
  StrainState state_;
  StrainVector q_ddot_;
};

/// What simple simulators do: q̇ += h q̈(q, q̇), q += h q̇. First order; unstable for ω h > 2, with explicit damping sooner.
class SemiImplicitEuler final : public Integrator {
 public:
  std::string name() const override { return "semi_implicit_euler"; }
  int order() const override { return 1; }
  StepEstimate step(const HeldBody& body, const MotionSegment& handle, double t, double h, StrainState& state) override;

 private:
  LastAcceleration last_;
};

/// The classical Runge–Kutta method of order four. Unstable for ω h > 2.8.
class RungeKutta4 final : public Integrator {
 public:
  std::string name() const override { return "rk4"; }
  int order() const override { return 4; }
  StepEstimate step(const HeldBody& body, const MotionSegment& handle, double t, double h, StrainState& state) override;

 private:
  LastAcceleration last_;
};

/// The paper's scheme (section 3.3): every coordinate on its own, the closed form of its damped oscillator initialised anew
/// each step with the coordinate's own inertia; what couples it to the others and to the hand is held over the step.
/// Here for any damping ratio. First order.
class ClosedForm final : public Integrator {
 public:
  std::string name() const override { return "closed_form"; }
  int order() const override { return 1; }
  StepEstimate step(const HeldBody& body, const MotionSegment& handle, double t, double h, StrainState& state) override;

 private:
  LastAcceleration last_;
};

/// Exponential Runge–Kutta method of order four (Krogstad's ETDRK4-B): the coupled linear part, frozen near the present
/// state, in closed form through its modes; the rest by four stages. Exact for linear systems whose handle accelerates
/// linearly in time; no stiffness limits its step.
class Exponential final : public Integrator {
 public:
  std::string name() const override { return "exponential"; }
  int order() const override { return 4; }
  bool unlimited() const override { return true; }
  StepEstimate step(const HeldBody& body, const MotionSegment& handle, double t, double h, StrainState& state) override;
  Response response(const HeldBody& body, double t, double h, const StrainState& state) override;

 private:
  static constexpr int most_modes = 2 * max_strain_coordinates;
  using Complex = std::complex<double>;
  using ModeVector = Eigen::Matrix<Complex, Eigen::Dynamic, 1, 0, most_modes, 1>;
  using FromModes = Eigen::Matrix<Complex, Eigen::Dynamic, Eigen::Dynamic, 0, most_modes, most_modes>;

  /// The φ-functions of one mode over the half and the whole step, times the step.
  struct ModeStep {
    Complex half_decay, half_1, half_2;
    Complex decay, one, two, three;
  };

  void linearise(const HeldBody& body, const HandleForcing& handle, const StrainState& state);
  void prepare(double h);
  void to_modes(const StrainState& state, ModeVector& z) const;
  void from_modes(const ModeVector& z, StrainState& state) const;
  /// What the linear part leaves over of the acceleration, in modes.
  ModeVector remainder(const StrainVector& q_ddot, const StrainState& state) const;

  long version_ = -1;
  double step_ = 0.0;
  int n_ = 0;
  StrainVector q_reference_;
  StrainMatrix stiffness_, damping_;  ///< frozen M⁻¹K and M⁻¹D, the loads' own stiffness included
  StrainMatrix inverse_mass_;
  ModeVector rates_;                  ///< eigenvalues; one of each conjugate pair
  FromModes to_modes_, from_modes_;   ///< state ↔ modes, state = Re(from_modes_ z)
  double fastest_ = 0.0;
  std::array<ModeStep, most_modes> mode_step_;
  LastAcceleration last_;
};

}  // namespace spring_workbench
