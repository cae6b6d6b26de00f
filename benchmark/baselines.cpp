#include "benchmark/baselines.h"

#include <algorithm>
#include <iterator>

namespace spring_workbench::benchmark {
namespace {

template <typename Baseline>
void append(std::vector<Baseline> more, std::vector<Baseline>& baselines) {
  baselines.insert(baselines.end(), std::make_move_iterator(more.begin()), std::make_move_iterator(more.end()));
}

}  // namespace

Baselines all_baselines() {
  Baselines baselines;
  append(hand_written_baselines(), baselines.methods);
  append(cvode_baselines(), baselines.methods);
  append(solver_baselines(), baselines.methods);
  baselines.found.push_back("CVODE and ARKODE " SPRING_WORKBENCH_CVODE_VERSION);
#ifdef SPRING_WORKBENCH_BULLET_VERSION
  append(bullet_baselines(), baselines.methods);
  append(bullet_rods(), baselines.rods);
  append(bullet_drags(), baselines.drags);
  append(bullet_boxes(), baselines.boxes);
  baselines.found.push_back("Bullet " SPRING_WORKBENCH_BULLET_VERSION);
#else
  baselines.not_found.push_back("Bullet in double precision (libbullet-dev)");
#endif
#ifdef SPRING_WORKBENCH_MUJOCO_VERSION
  append(mujoco_baselines(), baselines.methods);
  append(mujoco_rods(), baselines.rods);
  append(mujoco_drags(), baselines.drags);
  append(mujoco_boxes(), baselines.boxes);
  baselines.found.push_back("MuJoCo " SPRING_WORKBENCH_MUJOCO_VERSION);
  const auto is_implicitfast = [](const MethodPtr& method) { return method->name() == "mujoco_joints_implicitfast"; };
  if (std::none_of(baselines.methods.begin(), baselines.methods.end(), is_implicitfast))
    baselines.not_found.push_back("MuJoCo's implicitfast (MuJoCo 2.3.3 or later)");
#else
  baselines.not_found.push_back("MuJoCo (libmujoco-dev)");
#endif
#ifdef SPRING_WORKBENCH_ODE_VERSION
  append(ode_baselines(), baselines.methods);
  append(ode_rods(), baselines.rods);
  append(ode_drags(), baselines.drags);
  append(ode_boxes(), baselines.boxes);
  baselines.found.push_back("ODE " SPRING_WORKBENCH_ODE_VERSION);
#else
  baselines.not_found.push_back("ODE (libode-dev)");
#endif
#ifdef SPRING_WORKBENCH_DART_VERSION
  append(dart_baselines(), baselines.methods);
  append(dart_rods(), baselines.rods);
  append(dart_drags(), baselines.drags);
  baselines.found.push_back("DART " SPRING_WORKBENCH_DART_VERSION);
#else
  baselines.not_found.push_back("DART (libdart-dev)");
#endif
  return baselines;
}

}  // namespace spring_workbench::benchmark
