#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace spring_workbench::tools {

/// The tools (doc/model.md), in the order in which the stylus' second button selects them.
enum class Tool {
  spring,        ///< a spring-damper between the hand and the object's centre
  spring_fork,   ///< an elastic rod that bends, stretches and twists
  spring_probe,  ///< a spring along its axis that pushes bodies and measures their stiffness, but cannot hold them
  direct,        ///< a rigid link between the hand and the object
  ray,           ///< a rigid link between the hand and the object, which a ray along z of the hand selects
};

/// The words for the tools in settings, scenes and services.
inline std::vector<std::string> names_of(Tool) { return {"spring", "spring_fork", "spring_probe", "direct", "ray"}; }
inline bool can_hold(Tool tool) { return tool != Tool::spring_probe; }  ///< whether the tool can hold an object
/// Returns whether an object held by the tool turns with the hand.
inline bool turns_object(Tool tool) { return can_hold(tool) && tool != Tool::spring; }
/// Returns the tool after `tool` or, with `holding`, the next one that can hold an object.
inline Tool next_tool(Tool tool, bool holding) {
  const Tool next = static_cast<Tool>((static_cast<std::size_t>(tool) + 1) % names_of(tool).size());
  return holding && !can_hold(next) ? next_tool(next, holding) : next;
}

}  // namespace spring_workbench::tools
