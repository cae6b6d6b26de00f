#include "spring_workbench/math/damped_oscillator.h"

#include <cmath>

namespace spring_workbench::math {
namespace {

/// (∫₀ᵗ s dt) / t² by the Taylor series in t, for a = α t and w = ω₀² t² much smaller than 1.
double short_time_integral(double a, double w) {
  double before = 0.0, derivative = 1.0, factorial = 2.0, sum = 0.0;
  for (int n = 2; n < 13; ++n) {
    sum += derivative / factorial;
    const double next = -2.0 * a * derivative - w * before;
    before = derivative;
    derivative = next;
    factorial *= n + 1;
  }
  return sum;
}

}  // namespace

OscillatorStep damped_oscillator(double alpha, double omega_squared, double t) {
  // With the impulse response s(t), s(0) = 0, ṡ(0) = 1: x = (ṡ + 2 α s) x₀ + s v₀ + ∫s g.
  const double discriminant = alpha * alpha - omega_squared;
  const double x = discriminant * t * t;
  double s, s_dot, integral;
  if (std::abs(x) < 1e-3) {
    // Near critical damping: series of cosh√x and sinh√x/√x.
    const double decay = std::exp(-alpha * t);
    const double c = 1.0 + x / 2.0 * (1.0 + x / 12.0 * (1.0 + x / 30.0 * (1.0 + x / 56.0)));
    const double sinhc = 1.0 + x / 6.0 * (1.0 + x / 20.0 * (1.0 + x / 42.0 * (1.0 + x / 72.0)));
    s = decay * t * sinhc;
    s_dot = decay * (c - alpha * t * sinhc);
    integral = omega_squared * t * t > 1e-3 ? (1.0 - s_dot - 2.0 * alpha * s) / omega_squared
                                            : short_time_integral(alpha * t, omega_squared * t * t) * t * t;
  } else if (discriminant < 0.0) {
    const double omega = std::sqrt(-discriminant);
    const double decay = std::exp(-alpha * t);
    s = decay * std::sin(omega * t) / omega;
    s_dot = decay * std::cos(omega * t) - alpha * s;
    integral = (1.0 - s_dot - 2.0 * alpha * s) / omega_squared;
  } else {
    // Two real rates; the slow one without cancellation.
    const double root = std::sqrt(discriminant);
    const double fast = alpha + root;
    const double slow = omega_squared / fast;
    s = -std::exp(-slow * t) * std::expm1(-2.0 * root * t) / (2.0 * root);
    s_dot = (fast * std::exp(-fast * t) - slow * std::exp(-slow * t)) / (2.0 * root);
    const auto decayed = [t](double rate) { return rate * t > 1e-300 ? -std::expm1(-rate * t) / rate : t; };
    integral = (decayed(slow) - decayed(fast)) / (2.0 * root);
  }
  return {s_dot + 2.0 * alpha * s, s, integral, -omega_squared * s, s_dot, s};
}

}  // namespace spring_workbench::math
