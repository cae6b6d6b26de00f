#pragma once

#include <string>
#include <vector>

namespace spring_workbench::tools {

/// The tools (doc/model.md), in the order in which the stylus' second button selects them.
enum class Tool {
  spring,        ///< a spring-damper between the hand and the object's centre
  spring_fork,   ///< an elastic rod that bends, stretches and twists
  spring_probe,  ///< a spring along its axis, which pushes
  direct,        ///< rigid, at the hand
  ray,           ///< rigid; the object is selected by a ray along z of the hand
};

inline std::vector<std::string> names_of(Tool) { return {"spring", "spring_fork", "spring_probe", "direct", "ray"}; }
bool can_hold(Tool tool);  ///< whether the tool can hold an object
bool turns(Tool tool);     ///< whether the held object turns with the hand
/// Returns the next tool; with `holding`, the next one that can hold an object.
Tool next_tool(Tool tool, bool holding);

}  // namespace spring_workbench::tools
