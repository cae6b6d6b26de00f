#include "tools.h"

#include <yaml-cpp/yaml.h>

#include <utility>

namespace spring_workbench::assembly_trials {
namespace {

/// The tools of the paper's comparison (sections 4 and 6), as settings.
const std::vector<std::pair<std::string, std::string>>& tools() {
  static const std::vector<std::pair<std::string, std::string>> all = {
      {"spring_fork", "{tool: spring_fork}"},
      {"torsion_resistant", "{tool: spring_fork, fork.dofs.torsion: false}"},
      {"bend_only", "{tool: spring_fork, fork.dofs.torsion: false, fork.dofs.stretch: false}"},
      {"spring", "{tool: spring}"},
      {"direct", "{tool: direct}"},
      {"ray", "{tool: ray}"},
  };
  return all;
}

}  // namespace

std::vector<std::string> tool_labels() {
  std::vector<std::string> labels;
  for (const auto& tool : tools()) labels.push_back(tool.first);
  return labels;
}

simulation::SimulationSettings with_tool(const std::string& label, simulation::SimulationSettings base) {
  for (const auto& [name, settings] : tools()) {
    if (name == label) simulation::apply_settings(YAML::Load(settings), label, base);
  }
  return base;
}

}  // namespace spring_workbench::assembly_trials
