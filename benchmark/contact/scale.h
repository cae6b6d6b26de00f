#pragma once

#include <vector>

#include "spring_workbench/scene/scene.h"

namespace spring_workbench::benchmark {

/// What a number of resting objects costs while one of them is held and carried over the others.
struct ScaleRow {
  scene::ContactMode contact = scene::ContactMode::none;
  int objects = 0;
  double start = 0.0;   ///< to a simulation that can be stepped, the scene being in memory [s]
  double memory = 0.0;  ///< resident, beyond that of the scene [B]
  double step = 0.0;    ///< processor time of a 20 ms step, the least mean of ten over the run [s]
};

/// Measured in a process of its own, since memory is the process'. Throws std::runtime_error where that fails.
ScaleRow measure_scale(scene::ContactMode contact, int objects);

}  // namespace spring_workbench::benchmark
