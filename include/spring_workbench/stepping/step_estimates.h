#pragma once

#include <algorithm>

#include "spring_workbench/stepping/step_control.h"

namespace spring_workbench::stepping {

/// Error estimates of the steps of several spans, without discarded trial steps.
struct StepEstimates {
  double position = 0.0;  ///< [m]
  double angle = 0.0;     ///< [rad]
  double omega_dt = 0.0;  ///< ω·dt of the stiffest mode
  int extra_steps = 0;    ///< steps beyond one per span
  int substeps = 0;       ///< discarded attempts, repeated with a shorter step
  int stops = 0;          ///< steps that met the end of the fork's range
  int fallback = 0;       ///< steps taken by an L-stable rule in place of the integrator
  double energy = 0.0;    ///< sum of the estimated errors in energy [J]
  ErrorBounds bounds;

  void add(const StepEstimates& next) {
    position = std::max(position, next.position);
    angle = std::max(angle, next.angle);
    omega_dt = std::max(omega_dt, next.omega_dt);
    extra_steps += next.extra_steps;
    substeps += next.substeps;
    stops += next.stops;
    fallback += next.fallback;
    energy += next.energy;
    bounds.add(next.bounds);
  }

  void archive(math::StateArchive& state) {
    state(position, angle, omega_dt, extra_steps, substeps, stops, fallback, energy, bounds);
  }
};

}  // namespace spring_workbench::stepping
