#pragma once

#include <string>

#include "benchmark/rod_case.h"
#include "spring_workbench/simulation/simulation.h"

namespace spring_workbench::benchmark {

/// The scene of a rod case: its body alone, nothing to touch. A mass of 0 is a massless body.
scene::Scene rod_scene(const RodCase& one);

/// Settings under which Simulation runs the case: the body held from the first sample on, without contact.
simulation::SimulationSettings rod_settings(const RodCase& one, const std::string& shape, const std::string& integrator,
                                            double step);

}  // namespace spring_workbench::benchmark
