#pragma once

#include <ostream>

#include "benchmark/contact/trial_run.h"

namespace spring_workbench::benchmark {

/// Runs the trial until `time` [s] and writes a line of JSON for each shape: the body, whether it is held or movable,
/// and the shape's corners in world with the triangles or, of a cylinder or sphere, its sizes (plot_scene.py draws
/// them).
void show(const ContactTrial& trial, double time, std::ostream& out);

}  // namespace spring_workbench::benchmark
