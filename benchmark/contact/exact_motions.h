#pragma once

#include "benchmark/contact/trial_run.h"

namespace spring_workbench::benchmark {

/// Motions with exact solutions, each with steps of 20, 10, 5, 2.5 and 1.25 ms: a box that slides and stops, a sphere
/// that slips and then rolls, one that bounces, and a square prism that flies and tumbles; with contact mode `stop` on
/// the bench, and with `dynamic` on a loose slab of 1e6 kg that lies on it.
void run_motions(bool quick, const TakeRow& take);

/// A box or a hexagonal prism (a mesh) on an incline `off` [rad] from the angle of friction, kept awake.
ContactTrial incline(bool hull, scene::ContactMode contact, double off, double duration);
/// 0.1° below for 60 s: it stays; 0.1° above for 5 s: it slides as it must.
void run_inclines(bool quick, const TakeRow& take);

}  // namespace spring_workbench::benchmark
