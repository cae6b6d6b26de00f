#include "spring_workbench/tools/tool.h"

#include "spring_workbench/tools/settings.h"

namespace spring_workbench::tools {

const std::vector<std::string>& names_of(Tool) {
  static const std::vector<std::string> names = {"spring", "spring_fork", "spring_probe", "direct", "ray"};
  return names;
}

const std::vector<std::string>& names_of(Calibration) {
  static const std::vector<std::string> names = {"none", "object"};
  return names;
}

const std::vector<std::string>& names_of(Release) {
  static const std::vector<std::string> names = {"thrown", "dropped"};
  return names;
}

bool can_hold(Tool tool) { return tool != Tool::spring_probe; }

bool turns(Tool tool) { return can_hold(tool) && tool != Tool::spring; }

Tool next_tool(Tool tool, bool holding) {
  const Tool next = static_cast<Tool>((static_cast<std::size_t>(tool) + 1) % names_of(tool).size());
  return holding && !can_hold(next) ? next_tool(next, holding) : next;
}

}  // namespace spring_workbench::tools
