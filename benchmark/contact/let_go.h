#pragma once

#include "spring_workbench/math/so3.h"
#include "spring_workbench/simulation/simulation.h"

namespace spring_workbench::benchmark {

/// A simulation in which a rigid tool carries the scene's first body from its start pose for `held` [s] at `v` [m/s]
/// and `w` [rad/s], world axes, and then releases it with these velocities.
inline simulation::Simulation let_go(const scene::Scene& scene, double step, double held, const Vector3d& v,
                                     const Vector3d& w) {
  simulation::SimulationSettings set;
  set.fork.dofs = {false, false, false};
  set.dynamics.step = step;
  set.grasp.object = scene.bodies[0].name;
  simulation::Simulation s(scene, set);
  for (double time = 0.0; time < held + 0.04; time += 0.02) {
    RigidTransform X_WH = scene.bodies[0].X_WO;
    X_WH.translation() += time * v;
    X_WH.linear() = math::exp_so3(time * w) * X_WH.linear();
    X_WH.translation() -= set.fork.length * X_WH.linear().col(2);
    s.push_stylus({time, X_WH});
  }
  s.advance_to(held);
  s.release();
  return s;
}

}  // namespace spring_workbench::benchmark
