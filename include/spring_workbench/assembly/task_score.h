#pragma once

#include <string>

namespace spring_workbench::assembly {

/// Score of an assembly so far: the measures in which tools are compared (paper, section 6). The score stands
/// still while every object is in place.
struct TaskScore {
  int targets = 0;           ///< objects that have a target
  int placed = 0;            ///< number of these that are in place now
  double time = 0.0;         ///< from the first sample of a hand until all objects are in place, or until now [s]
  double hand_path = 0.0;    ///< total path length of the hands [m]
  double object_path = 0.0;  ///< total path length of the centres of mass of held objects [m]
  int grasps = 0;            ///< number of grasps
  int collisions =
      0;           ///< number of times that a held object hit something; setting it down on a fixed body does not count
  int drops = 0;   ///< releases after which the object fell by more than 2 cm
  int broken = 0;  ///< objects on which a contact force exceeded the `max_force` of their target
  double largest_force = 0.0;   ///< largest force between an object and another body, as a mean over 20 ms [N]
  double position_error = 0.0;  ///< current mean over the targets [m]
  double angle_error = 0.0;     ///< current mean over the targets that constrain the angle [rad]
  bool complete() const { return targets > 0 && placed == targets; }
};

/// Names of the columns of `score_csv`, with their units.
std::string score_csv_header();
/// The score as one CSV row without a line break; numbers have nine digits.
std::string score_csv(const TaskScore& score);

}  // namespace spring_workbench::assembly
