#pragma once

#include <string>
#include <vector>

#include "benchmark/contact/box_engines.h"
#include "benchmark/contact/drag.h"
#include "benchmark/method.h"
#include "benchmark/rod_engine.h"

namespace spring_workbench::benchmark {

/// Hand-written integrators as by a competent programmer: semi-implicit Euler and RK4 with the spring as a force.
std::vector<MethodPtr> hand_written_baselines();

/// SUNDIALS CVODE as a general solver, by tolerance: on the object's pose in world, like the other baselines, and on
/// the deflection, with tolerances scaled to its size.
std::vector<MethodPtr> cvode_baselines();

/// General methods on the library's own equation of motion: RK4, DOP853, Radau IIA, CVODE by BDF and Adams, ARKODE
/// explicit and diagonally implicit (solver_run.h).
std::vector<MethodPtr> solver_baselines();

/// Bullet, double precision: the spring as an explicit force, and the 6-DOF spring 2 constraint to a kinematic hand
/// with its silent stiffness limit on (its default) and off.
std::vector<MethodPtr> bullet_baselines();

/// MuJoCo: the spring as a passive force (Euler, RK4), joints with springs and dampers on a driven hand (Euler with
/// implicit joint damping, implicit and, in MuJoCo 2.3.3 or later, implicitfast), and a weld to a mocap body.
std::vector<MethodPtr> mujoco_baselines();

/// ODE: motors whose target velocity and CFM make an implicit spring-damper of given stiffness and damping.
std::vector<MethodPtr> ode_baselines();

/// DART: implicit joint springs on a driven hand.
std::vector<MethodPtr> dart_baselines();

/// The engines with the rod's law as a force of the start and of the end of the step (RodForce); MuJoCo by its Euler
/// method and, with the force of each stage, by Runge–Kutta.
std::vector<RodEngine> bullet_rods();
std::vector<RodEngine> mujoco_rods();
std::vector<RodEngine> ode_rods();
std::vector<RodEngine> dart_rods();

/// The baselines that were found at configuration time, and those that were not.
struct Baselines {
  std::vector<MethodPtr> methods;
  std::vector<RodEngine> rods;         ///< the engines on rods
  std::vector<DragMethod> drags;       ///< the engines on the drag scene
  std::vector<BoxEngine> boxes;        ///< the engines on piles and stacks of boxes
  std::vector<std::string> found;      ///< engine and version
  std::vector<std::string> not_found;  ///< engine and the Debian package that provides it
};
Baselines all_baselines();

}  // namespace spring_workbench::benchmark
