#pragma once

#include <urdf_model/model.h>

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace spring_workbench::scene {

/// A URDF file as urdfdom reads it, with what it would have dropped in silence.
struct UrdfFile {
  std::string path;
  std::shared_ptr<urdf::ModelInterface> model;
  /// Links whose `<inertial>` urdfdom cannot read, with the mass [kg] where that is given as a number > 0.
  std::map<std::string, std::optional<double>> unreadable_inertials;
  std::map<std::string, int> link_lines;
  std::vector<std::string> warnings;

  /// "<file>:<line>: link '<name>'"
  std::string where(const std::string& link) const;
};

/// Reads a URDF. urdfdom stops reading a link at the first element that it does not understand and says so on the
/// console only: each inertial, visual and collision is therefore tried by itself first, and what urdfdom does not know
/// is taken out with a warning. Throws InputError with urdfdom's reason for everything else that it refuses.
UrdfFile read_urdf_file(const std::string& path);

}  // namespace spring_workbench::scene
