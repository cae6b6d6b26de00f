#pragma once

#include <string>
#include <vector>

#include "benchmark/scenarios.h"
#include "spring_workbench/dynamics/held_body.h"

namespace spring_workbench::benchmark {

constexpr double kSameTime = 1e-9;  ///< [s]; times closer to each other count as equal

/// A body held by the spring-fork on a hand that is known by samples, as in applications. Strain and strain rate are
/// zero at the first sample, at t = 0; the tip frame has the orientation of the object frame.
struct RodCase {
  std::string name;
  double stiffness_factor = 1.0;                     ///< stiffness of `fork` relative to the default
  double mass = 1.0;                                 ///< [kg]
  Vector3d inertia = Vector3d(0.004, 0.006, 0.005);  ///< about the centre of mass, principal [kg·m²]
  Vector3d p_OE = Vector3d(0.03, 0.02, -0.05);       ///< position of the tip in the object [m]
  rod::ForkSettings fork;                            ///< except for its shape
  std::vector<std::string> shapes;                   ///< shape models to run it with
  std::vector<motion::PoseSample> hand;              ///< from t = 0 to beyond the end
  std::vector<motion::PoseSample> fine_hand;         ///< the same hand at 2 kHz; empty if not known
  double duration = 4.0;                             ///< [s]
  double output_interval = 0.02;                     ///< [s]
  std::string recorded;                              ///< file with the trajectory by another solver, or empty
};

/// A hand's motion from t = 0 to `duration` [s] in samples `interval` [s] apart, made from `seed`: sines of 0.2 to 2.5
/// Hz in position (some 0.15 m) and rotation (some 0.6 rad) with a tremor of 8 to 12 Hz (0.1 mm, 2 mrad), from rest
/// (kRamp). The fork points forward and up.
std::vector<motion::PoseSample> synthetic_hand(unsigned seed, double duration, double interval = 0.02);

/// The samples of a file `t x y z qx qy qz qw`; empty if there is no file.
std::vector<motion::PoseSample> read_motion(const std::string& path);

/// The synthetic cases: soft, underdamped, stiff, heavy with large bends, and each DOF alone, each with every shape
/// model; then, with the default shape only, soft and stiff forks with light and heavy bodies ("soft_light" and so on).
/// `quick`: a few of these.
std::vector<RodCase> synthetic_cases(bool quick);

/// The cases of the reference trajectories in `folder`, each with its own shape model; empty if there are none.
std::vector<RodCase> recorded_cases(const std::string& folder);

/// Scene A, B or C as a case of the `bushing` with the scene's dampers and, in A and B, the other DOFs off; without
/// poses if the hand is a function of time.
RodCase rod_case(const Scenario& scene);

/// The body on the fork, in the coordinates of `shape`.
dynamics::HeldBody held_body(const RodCase& one, const std::string& shape);

/// The hand's motion through all samples.
motion::PoseTrack hand_track(const RodCase& one);

/// Amplitude of the hand: the largest distance of a position from their mean [m].
double hand_amplitude(const RodCase& one);

/// 0, output_interval, …, duration [s].
std::vector<double> output_times(const RodCase& one);

/// Times at which a step must end, in order: the outputs and the samples up to the last output [s].
std::vector<double> step_ends(const RodCase& one);

}  // namespace spring_workbench::benchmark
