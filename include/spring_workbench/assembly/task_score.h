#pragma once

#include <string>

namespace spring_workbench::assembly {

/// How well an assembly was done so far: what the paper's comparison of tools (section 6) is counted in. Counting stops
/// while every object is in place.
struct TaskScore {
  int targets = 0;           ///< objects that have a target
  int placed = 0;            ///< of them in place at present
  double time = 0.0;         ///< from the first sample of the hand until all are in place, or until now [s]
  double hand_path = 0.0;    ///< path length of the hand [m]
  double object_path = 0.0;  ///< path length of the centres of mass of held objects [m]
  int grasps = 0;            ///< times that an object was grasped
  int collisions = 0;        ///< times that a held object hit something; setting it down on a fixed body does not count
  int drops = 0;             ///< releases after which the object fell by more than 2 cm
  int broken = 0;            ///< objects with a target that were pressed by more than its largest force
  double largest_force = 0.0;   ///< between an object and what it touches [N]
  double position_error = 0.0;  ///< mean over the targets, at present [m]
  double angle_error = 0.0;     ///< mean over the targets that ask for an angle, at present [rad]
  bool complete() const { return targets > 0 && placed == targets; }
};

/// Names of the columns of `score_csv`, with units where they have one.
std::string score_csv_header();
/// The score as one line of CSV without the end of line; numbers with nine digits.
std::string score_csv(const TaskScore& score);

}  // namespace spring_workbench::assembly
