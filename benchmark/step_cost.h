#pragma once

#include <string>
#include <vector>

namespace spring_workbench::benchmark {

/// Cost of one call of a part of a step.
struct StepCost {
  std::string shape;    ///< shape model
  int coordinates = 0;  ///< active strain coordinates
  std::string part;
  double nanoseconds = 0.0;  ///< processor time of this thread: minimum over many short runs
};

template <typename Fields>
void each_field(StepCost& c, Fields& fields) {
  fields(c.shape, c.coordinates, c.part, c.nanoseconds);
}

/// Measures the parts of a step of `exponential` for each shape model, with all DOFs on and with stretch alone, for the
/// box of scene C at a hundred times its stiffness: hand between two samples, hand at one time, kinematics of the tip,
/// mass matrix, acceleration (one stage), pose and velocity of the object, a step, a step with a new length, a step
/// after a change of stiffness.
std::vector<StepCost> step_costs();

/// Keeps the smaller cost of each part. A shard that measured only one of two rounds has no rows of the other one.
void keep_least(const std::vector<StepCost>& again, std::vector<StepCost>& costs);

}  // namespace spring_workbench::benchmark
