#pragma once

namespace spring_workbench::math {

/// The exact solution of `ẍ + 2 α ẋ + ω₀² x = g` over a time, g constant (paper, section 3.3; here for every damping):
/// x(t) = xx x₀ + xv v₀ + xg g,  ẋ(t) = vx x₀ + vv v₀ + vg g.
struct OscillatorStep {
  double xx, xv, xg;
  double vx, vv, vg;
  /// Carries position and velocity over the time, without g.
  void carry(double& x, double& v) const {
    const double x0 = x;
    x = xx * x0 + xv * v;
    v = vx * x0 + vv * v;
  }
};

/// `alpha` ≥ 0 [1/s] is the damping ratio times ω₀, `omega_squared` ≥ 0 [1/s²], `t` ≥ 0 [s]. Does not divide by zero at
/// critical damping (alpha² = omega_squared), at omega_squared = 0 or at t = 0.
OscillatorStep damped_oscillator(double alpha, double omega_squared, double t);

}  // namespace spring_workbench::math
