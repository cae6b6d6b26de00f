#pragma once

#include <vector>

#include "spring_workbench/scene/scene.h"

namespace spring_workbench::benchmark {

/// Cost of a number of resting objects while one of them is held and carried over the others.
struct ScaleRow {
  scene::ContactMode contact = scene::ContactMode::none;
  int objects = 0;
  double start = 0.0;   ///< time to construct a simulation from a loaded scene [s]
  double memory = 0.0;  ///< resident memory beyond that of the scene [B]
  double step = 0.0;    ///< processor time of a 20 ms step: smallest mean over ten steps of the run [s]
};

/// Measures in a separate process, because memory is per process. Throws std::runtime_error if that fails.
ScaleRow measure_scale(scene::ContactMode contact, int objects);

}  // namespace spring_workbench::benchmark
