#pragma once

#include <mujoco/mujoco.h>

#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace spring_workbench::benchmark {

/// MuJoCo's virtual file system, empty. It is made once, since it clears 2 MB; call this before child processes use it.
mjVFS& mujoco_files();

/// A compiled model of MuJoCo and its data. For the sources that call MuJoCo alone.
struct MujocoWorld {
  /// Compiles a model in MJCF. Throws std::runtime_error with MuJoCo's message if it is not valid.
  explicit MujocoWorld(const std::string& xml);

  std::unique_ptr<mjModel, decltype(&mj_deleteModel)> model;
  std::unique_ptr<mjData, decltype(&mj_deleteData)> data;
};

/// The integrators that treat a joint's damping implicitly, by the names of the methods with joints. MuJoCo has
/// `implicitfast` since 2.3.3.
std::vector<std::pair<std::string, mjtIntegrator>> mujoco_joint_modes();

}  // namespace spring_workbench::benchmark
