#pragma once

#include <string>
#include <vector>

namespace spring_workbench::benchmark {

/// What one call of a part of a step costs.
struct StepCost {
  std::string shape;    ///< shape model
  int coordinates = 0;  ///< active strain coordinates
  std::string part;
  double nanoseconds = 0.0;  ///< processor time of this thread: least of many short runs
};

template <typename Fields>
void each_field(StepCost& c, Fields& fields) {
  fields(c.shape, c.coordinates, c.part, c.nanoseconds);
}

/// The parts of a step of `exponential` for each shape model with all families on and with stretch alone, on the box of
/// scene C at a hundred times its stiffness: the hand between two samples, the hand at one moment, the tip's
/// kinematics, the mass matrix, the acceleration (one stage), the object's pose and velocity, a step, a step of another
/// length than the last one, a step after a change of stiffness.
std::vector<StepCost> step_costs();

}  // namespace spring_workbench::benchmark
