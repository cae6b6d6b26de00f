#pragma once

#include <string>
#include <vector>

namespace spring_workbench {

/// The tools of doc/model.md, in the order in which the stylus' second button goes through them.
enum class Tool {
  spring,       ///< a spring-damper between the hand and the object's centre
  spring_fork,  ///< the rod
  direct,       ///< rigid, at the hand
  ray,          ///< rigid, picked by a ray along z of the hand
};

const std::vector<std::string>& tool_names();
std::string name_of(Tool tool);
/// Throws InputError naming `where` for a name that is not in tool_names().
Tool tool_called(const std::string& name, const std::string& where);
Tool next_tool(Tool tool);

}  // namespace spring_workbench
