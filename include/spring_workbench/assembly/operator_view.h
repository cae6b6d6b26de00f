#pragma once

#include <algorithm>
#include <string>
#include <vector>

#include "spring_workbench/bodies/body_state.h"
#include "spring_workbench/validation/number_rule.h"

namespace spring_workbench::assembly {

/// What the simulated operator perceives at one moment.
struct OperatorView {
  /// The tool in one hand.
  struct Tool {
    RigidTransform X_HE = RigidTransform::Identity();  ///< pose of its tip at rest, in the handle frame
    bool turns = true;                                 ///< whether it turns the held object: all tools but `spring` do
    std::string held_object;                           ///< empty: nothing
  };
  std::vector<bodies::BodyState> objects;  ///< the movable ones
  std::vector<Tool> tools;                 ///< one per hand

  bool turns() const {
    return std::all_of(tools.begin(), tools.end(), [](const Tool& tool) { return tool.turns; });
  }
  /// Throws InputError if there is no object of this name.
  const bodies::BodyState& object(const std::string& name) const {
    for (const bodies::BodyState& state : objects) {
      if (state.name == name) return state;
    }
    validation::refuse("operator", "object", name, "an object of the scene");
  }
};

}  // namespace spring_workbench::assembly
