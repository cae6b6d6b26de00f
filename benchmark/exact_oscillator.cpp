#include "benchmark/exact_oscillator.h"

#include <cmath>
#include <complex>

namespace spring_workbench::benchmark {
namespace {

/// Solution of ẍ + 2 σ ẋ + ω² x = 0 from x₀, v₀.
ScalarMotion transient(double omega, double zeta, double x0, double v0, double t) {
  const double sigma = zeta * omega;
  const double discriminant = omega * omega - sigma * sigma;
  const double slope = v0 + sigma * x0;
  double x = 0.0;  // e^{−σt} (x₀ C + slope S), with C and S the (hyperbolic) cosine and sine and their limit
  double v = 0.0;
  const double root = std::sqrt(std::abs(discriminant));
  if (root * t < 1e-6) {
    const double decay = std::exp(-sigma * t);
    x = decay * (x0 + slope * t);
    v = decay * (slope - sigma * (x0 + slope * t));
  } else if (discriminant > 0.0) {
    const double decay = std::exp(-sigma * t);
    const double c = std::cos(root * t), s = std::sin(root * t);
    x = decay * (x0 * c + slope * s / root);
    v = -sigma * x + decay * (slope * c - x0 * root * s);
  } else {
    const double fast = std::exp(-(sigma + root) * t), slow = std::exp(-omega * omega / (sigma + root) * t);
    const double c = 0.5 * (slow + fast), s = 0.5 * (slow - fast);
    x = x0 * c + slope * s / root;
    v = -sigma * x + slope * c + x0 * root * s;
  }
  return {x, v, -2.0 * sigma * v - omega * omega * x};
}

}  // namespace

ScalarMotion exact_deflection(const Scenario& scene, double t) {
  const double inertia = scene.single_inertia();
  const double k = scene.stiffness[scene.single_coordinate()];
  const double c = scene.damping[scene.single_coordinate()];
  const ScalarMotion start = scalar_hand(scene, 0.0);
  const double amplitude = hand_amplitude(scene);
  const double Omega = start.rate / amplitude;
  const double weight = scene.kind == SceneKind::stretch ? inertia * scene.gravity : 0.0;
  const double sag = -weight / k;

  // Steady part Im(X e^{iΩt}) of the drive M a Ω² sin Ωt.
  const std::complex<double> i(0.0, 1.0);
  const std::complex<double> X =
      inertia * amplitude * Omega * Omega / std::complex<double>(k - inertia * Omega * Omega, c * Omega);
  const std::complex<double> turned = X * std::exp(i * Omega * t);
  const ScalarMotion rest =
      transient(std::sqrt(k / inertia), scene.damping_ratio, -sag - X.imag(), -(i * Omega * X).imag(), t);
  return {sag + turned.imag() + rest.value, (i * Omega * turned).imag() + rest.rate,
          -Omega * Omega * turned.imag() + rest.acceleration};
}

Vector3d exact_output(const Scenario& scene, double t) {
  return Vector3d(0.0, 0.0, scalar_hand(scene, t).value + exact_deflection(scene, t).value);
}

std::vector<Vector3d> exact_outputs_on_samples(const Scenario& scene) {
  const double inertia = scene.single_inertia();
  const double k = scene.stiffness[scene.single_coordinate()];
  const double c = scene.damping[scene.single_coordinate()];
  const double gravity = scene.kind == SceneKind::stretch ? scene.gravity : 0.0;
  const std::vector<double> times = output_times(scene);
  std::vector<Vector3d> outputs{Vector3d(0.0, 0.0, scalar_hand(scene, 0.0).value)};
  double x = 0.0, v = 0.0;
  for (std::size_t i = 0; i + 1 < times.size(); ++i) {
    const double t = times[i], h = times[i + 1] - t;
    const double start = scalar_hand(scene, t).acceleration, middle = scalar_hand(scene, t + 0.5 * h).acceleration;
    const double slope = -inertia * (middle - start) / (0.5 * h * k);
    const double steady = (-inertia * (gravity + start) - c * slope) / k;
    const ScalarMotion rest = transient(std::sqrt(k / inertia), scene.damping_ratio, x - steady, v - slope, h);
    x = steady + slope * h + rest.value;
    v = slope + rest.rate;
    outputs.emplace_back(0.0, 0.0, scalar_hand(scene, times[i + 1]).value + x);
  }
  return outputs;
}

}  // namespace spring_workbench::benchmark
