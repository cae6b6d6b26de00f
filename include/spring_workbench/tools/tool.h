#pragma once

#include <string>
#include <vector>

namespace spring_workbench::tools {

/// The tools of doc/model.md, in the order in which the stylus' second button goes through them.
enum class Tool {
  spring,        ///< a spring-damper between the hand and the object's centre
  spring_fork,   ///< the rod
  spring_probe,  ///< a spring along its axis that pushes and presses
  direct,        ///< rigid, at the hand
  ray,           ///< rigid, picked by a ray along z of the hand
};

inline std::vector<std::string> names_of(Tool) { return {"spring", "spring_fork", "spring_probe", "direct", "ray"}; }
bool can_hold(Tool tool);
/// Whether what is held turns with the hand.
bool turns(Tool tool);
/// The one after it; of those that can hold where `holding`.
Tool next_tool(Tool tool, bool holding);

}  // namespace spring_workbench::tools
