#pragma once

#include <ostream>

#include "benchmark/contact/trial_run.h"

namespace spring_workbench::benchmark {

/// Runs the trial until `time` [s] and writes a line of JSON for each shape, for plot_scene.py: the body, whether it is
/// held or movable, and the shape's vertices in world with the triangles or, for a cylinder or sphere, its dimensions.
void show(const ContactTrial& trial, double time, std::ostream& out);

}  // namespace spring_workbench::benchmark
