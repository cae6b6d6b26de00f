#pragma once

#include <string>
#include <vector>

namespace spring_workbench::dynamics {

/// How the held body's state is carried over a step (doc/model.md, "Integrators").
enum class IntegratorKind { exponential, rosenbrock, implicit_euler, paper, semi_implicit_euler, rk4 };
const std::vector<std::string>& names_of(IntegratorKind);

enum class Inertia { exact, point_mass };  ///< the held object's own, or the paper's I = r² m (section 3.1)
const std::vector<std::string>& names_of(Inertia);

/// Integrator and steps of the held objects.
struct DynamicsSettings {
  IntegratorKind integrator = IntegratorKind::exponential;  ///< key `integrator`
  double step = 0.02;        ///< key `step` [s], 1e-6 … 1: the largest step; a step also ends at every sample
  double tolerance = 0.0;    ///< key `tolerance` [m], 0 … 0.1: for the error of the run; 0: fixed steps
  bool error_bound = false;  ///< key `error_bound`: whether the run's error is bounded (doc/model.md, "Error bound")
  Inertia inertia = Inertia::exact;  ///< key `inertia`
};

}  // namespace spring_workbench::dynamics
