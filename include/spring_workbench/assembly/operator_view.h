#pragma once

#include <algorithm>
#include <string>
#include <vector>

#include "spring_workbench/bodies/body_state.h"
#include "spring_workbench/validation/number_rule.h"

namespace spring_workbench::assembly {

/// What the simulated operator sees at one moment.
struct OperatorView {
  /// The tool in one hand.
  struct Tool {
    RigidTransform X_HE = RigidTransform::Identity();  ///< its tip at rest, in the handle
    bool turns = true;                                 ///< it turns what it holds: all but `spring` do
    std::string held_object;                           ///< empty: nothing
  };
  std::vector<bodies::BodyState> objects;  ///< the movable ones
  std::vector<Tool> tools;                 ///< one per hand

  bool turns() const {
    return std::all_of(tools.begin(), tools.end(), [](const Tool& tool) { return tool.turns; });
  }
  /// Throws InputError if it is not seen.
  const bodies::BodyState& object(const std::string& name) const {
    for (const bodies::BodyState& state : objects) {
      if (state.name == name) return state;
    }
    validation::refuse("operator", "object", name, "an object of the scene");
  }
};

}  // namespace spring_workbench::assembly
