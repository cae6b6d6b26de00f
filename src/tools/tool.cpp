#include "spring_workbench/tools/tool.h"

#include <algorithm>

#include "spring_workbench/validation/number_rule.h"

namespace spring_workbench::tools {

const std::vector<std::string>& tool_names() {
  static const std::vector<std::string> names = {"spring", "spring_fork", "spring_probe", "direct", "ray"};
  return names;
}

std::string name_of(Tool tool) { return tool_names()[static_cast<std::size_t>(tool)]; }

Tool tool_called(const std::string& name, const std::string& where) {
  const auto found = std::find(tool_names().begin(), tool_names().end(), name);
  if (found == tool_names().end()) validation::refuse(where, "tool", name, "one of " + validation::join(tool_names()));
  return static_cast<Tool>(found - tool_names().begin());
}

bool can_hold(Tool tool) { return tool != Tool::spring_probe; }

bool turns(Tool tool) { return can_hold(tool) && tool != Tool::spring; }

Tool next_tool(Tool tool, bool holding) {
  const Tool next = static_cast<Tool>((static_cast<std::size_t>(tool) + 1) % tool_names().size());
  return holding && !can_hold(next) ? next_tool(next, holding) : next;
}

}  // namespace spring_workbench::tools
