#pragma once

#include <map>
#include <optional>
#include <string>

#include "spring_workbench/scene/scene.h"

namespace spring_workbench::scene {

/// One entry of a scene file's `objects:`.
struct ObjectEntry {
  std::string where;  ///< "<file>:<line>"
  Material material;
  bool massless = false;
  std::optional<std::string> urdf;     ///< the object's own URDF, as written in the file
  std::optional<RigidTransform> X_WL;  ///< pose of its link frame; absent: it stands on the bench at x = y = 0
};

/// The YAML file next to a URDF. Defaults are those of `Scene`, `Material` and `Target`.
struct SceneFile {
  Scene settings;         ///< everything but name, path, bodies and warnings
  bool massless = false;  ///< default for all objects without an entry of their own
  std::map<std::string, ObjectEntry> objects;
  std::map<std::string, std::string> targets;  ///< name → "<file>:<line>"
};

/// Key of `start:` for a hand, from 0: handle, handle_2, ...
inline std::string handle_key(std::size_t hand) { return hand == 0 ? "handle" : "handle_" + std::to_string(hand + 1); }

/// Path of the YAML file next to a URDF, which may not exist: .yml if there is such a file, otherwise .yaml. Throws
/// InputError if there are both.
std::string yaml_next_to(const std::string& urdf);

/// Reads a scene file. Throws InputError with file:line, key, value and rule; unknown keys are refused.
SceneFile read_scene_file(const std::string& path);

}  // namespace spring_workbench::scene
