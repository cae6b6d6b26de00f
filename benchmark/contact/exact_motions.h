#pragma once

#include "benchmark/contact/trial_run.h"

namespace spring_workbench::benchmark {

/// Result of a motion with an exact solution.
struct MotionRun {
  double error = 0.0;           ///< largest distance of the object from its exact position, every 20 ms [m]
  double displacement = 0.0;    ///< largest distance of the exact position from the start [m]
  double duration = 0.0;        ///< simulated [s]
  double processor_time = 0.0;  ///< [s]
  Measured measured;
};
/// The names of those motions below in which the object touches something.
std::vector<std::string> motions_in_contact();
/// Runs a motion with steps of at most `step` [s].
MotionRun run_motion(const std::string& name, scene::ContactMode contact, double step);

/// Motions with exact solutions, each with steps of 20, 10, 5, 2.5 and 1.25 ms: a box that slides and stops, a sphere
/// that slips and then rolls, one that bounces, and a square prism that flies and tumbles; with contact mode `stop` on
/// the bench, and with `dynamic` on a loose slab of 1e6 kg that lies on it.
void run_motions(bool quick, const TakeRow& take);

/// A box or a hexagonal prism (a mesh) on an incline whose angle differs from the friction angle by `off` [rad]; kept
/// awake.
ContactTrial incline(bool hull, scene::ContactMode contact, double off, double duration);
/// Tests that a body stays for 60 s at 0.1° below the friction angle, and slides with the exact acceleration for 5 s at
/// 0.1° above it.
void run_inclines(bool quick, const TakeRow& take);

}  // namespace spring_workbench::benchmark
