#include "spring_workbench/tools/tool.h"

#include <algorithm>

#include "spring_workbench/config/yaml_fields.h"

namespace spring_workbench {

const std::vector<std::string>& tool_names() {
  static const std::vector<std::string> names = {"spring", "spring_fork", "direct", "ray"};
  return names;
}

std::string name_of(Tool tool) { return tool_names()[static_cast<std::size_t>(tool)]; }

Tool tool_called(const std::string& name, const std::string& where) {
  const auto found = std::find(tool_names().begin(), tool_names().end(), name);
  if (found == tool_names().end()) refuse(where, "tool", name, "one of " + join(tool_names()));
  return static_cast<Tool>(found - tool_names().begin());
}

Tool next_tool(Tool tool) {
  return static_cast<Tool>((static_cast<std::size_t>(tool) + 1) % tool_names().size());
}

}  // namespace spring_workbench
