#pragma once

#include <string>
#include <vector>

namespace spring_workbench::dynamics {

/// Methods of integration (doc/model.md, "Integrators"): exponential collocation; RODASP; implicit Euler; the scheme of
/// Koutek and Post; and, for comparison, semi-implicit Euler and RK4, which need short steps on a stiff fork.
enum class IntegratorKind { exponential, rosenbrock, implicit_euler, paper, semi_implicit_euler, rk4 };
/// The words for the methods in settings, built in or registered.
const std::vector<std::string>& names_of(IntegratorKind);

/// Inertia of the held object: its own tensor, or I = r² m as in the paper (section 3.1).
enum class Inertia { exact, point_mass };
const std::vector<std::string>& names_of(Inertia);  ///< words for the inertias in settings

/// Integrator and steps of the held objects.
struct DynamicsSettings {
  IntegratorKind integrator = IntegratorKind::exponential;  ///< method of integration (key `integrator`)
  double step = 0.02;        ///< key `step` [s], 1e-6 … 1: the largest step; a step also ends at every sample
  double tolerance = 0.0;    ///< key `tolerance` [m], 0 … 0.1: allowed error of the whole run; 0: fixed steps
  bool error_bound = false;  ///< key `error_bound`: whether to bound the run's error (doc/model.md, "Error bound")
  Inertia inertia = Inertia::exact;  ///< inertia of the held object (key `inertia`)
};

}  // namespace spring_workbench::dynamics
