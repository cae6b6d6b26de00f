#pragma once

#include <string>
#include <vector>

#include "benchmark/scenarios.h"
#include "spring_workbench/dynamics/held_body.h"

namespace spring_workbench::benchmark {

constexpr double kSameTime = 1e-9;  ///< [s]: moments nearer to each other are one

/// A body held by the spring-fork on a hand that is known by samples: what a user of the package has. Zero strain and
/// zero strain rate at the first sample, at t = 0; the tip frame has the object frame's orientation.
struct RodCase {
  std::string name;
  double stiffness_factor = 1.0;                     ///< of `fork` over the default's
  double mass = 1.0;                                 ///< [kg]
  Vector3d inertia = Vector3d(0.004, 0.006, 0.005);  ///< about the centre of mass, principal [kg·m²]
  Vector3d p_OE = Vector3d(0.03, 0.02, -0.05);       ///< the tip in the object [m]
  rod::ForkSettings fork;                            ///< but for its shape
  std::vector<std::string> shapes;                   ///< the shape models it is run with
  std::vector<motion::PoseSample> hand;              ///< from t = 0 to beyond the end
  double duration = 4.0;                             ///< [s]
  double output_interval = 0.02;                     ///< [s]
  std::string recorded;                              ///< file with the trajectory by another solver, or empty
};

/// A hand's motion at 50 Hz from t = 0 to `duration` [s], made from `seed`: sines of 0.2 to 2.5 Hz in position (some
/// 0.15 m) and rotation (some 0.6 rad) with a tremor of 8 to 12 Hz (0.1 mm, 2 mrad). The fork points forward and up.
std::vector<motion::PoseSample> synthetic_hand(unsigned seed, double duration);

/// The samples of a file `t x y z qx qy qz qw`; none if it is not there.
std::vector<motion::PoseSample> read_motion(const std::string& path);

/// The cases of the package's own: soft, underdamped, stiff, heavy with large bends, and each family alone, each with
/// every shape model; then, with the default shape alone, soft and stiff forks with light and heavy bodies
/// ("soft_light" and so on). A few of them where `quick`.
std::vector<RodCase> synthetic_cases(bool quick);

/// The cases of the reference trajectories in `folder`, each with its own shape model; none where they are not there.
std::vector<RodCase> recorded_cases(const std::string& folder);

/// Scene A, B or C as a case of the `bushing` with the scene's dampers, the other families off in A and B; without
/// poses where its hand is a function of time.
RodCase rod_case(const Scenario& scene);

/// The body on the fork, in the coordinates of `shape`.
dynamics::HeldBody held_body(const RodCase& one, const std::string& shape);

/// The hand's motion through all samples.
motion::PoseTrack hand_track(const RodCase& one);

/// Half the largest distance between two places of the hand, roughly: the largest distance from their mean [m].
double hand_amplitude(const RodCase& one);

/// 0, output_interval, …, duration [s].
std::vector<double> output_times(const RodCase& one);

/// Times at which a step must end: the outputs and the samples up to the last output, in their order [s].
std::vector<double> step_ends(const RodCase& one);

}  // namespace spring_workbench::benchmark
