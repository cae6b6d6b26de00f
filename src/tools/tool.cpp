#include "spring_workbench/tools/tool.h"

namespace spring_workbench::tools {

bool can_hold(Tool tool) { return tool != Tool::spring_probe; }

bool turns(Tool tool) { return can_hold(tool) && tool != Tool::spring; }

Tool next_tool(Tool tool, bool holding) {
  const Tool next = static_cast<Tool>((static_cast<std::size_t>(tool) + 1) % names_of(tool).size());
  return holding && !can_hold(next) ? next_tool(next, holding) : next;
}

}  // namespace spring_workbench::tools
