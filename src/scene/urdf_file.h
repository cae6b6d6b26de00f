#pragma once

#include <urdf_model/model.h>

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace spring_workbench::scene {

/// A URDF file as read by urdfdom, with what urdfdom would have dropped silently.
struct UrdfFile {
  std::string path;
  std::shared_ptr<urdf::ModelInterface> model;
  /// Links whose `<inertial>` urdfdom cannot read, with the mass [kg] if that is given as a number > 0.
  std::map<std::string, std::optional<double>> unreadable_inertials;
  std::map<std::string, int> link_lines;
  std::vector<std::string> warnings;

  /// "<file>:<line>: link '<name>'"
  std::string where(const std::string& link) const;
};

/// Reads a URDF. urdfdom stops reading a link at the first element that it does not understand, and reports it only on
/// the console. So each inertial, visual and collision is first tried separately, and unknown ones are removed with a
/// warning. Throws InputError with urdfdom's reason for everything else that it refuses.
UrdfFile read_urdf_file(const std::string& path);

}  // namespace spring_workbench::scene
