#pragma once

#include <optional>
#include <string>
#include <vector>

#include "spring_workbench/scene/scene.h"

namespace spring_workbench::scene {

/// A body called `name` from an object's own URDF, a path, absolute or beside that of `scene`, or a package:// URI: its
/// link frame at `X_WL`, or lying on the bench at x = y = 0; with the materials that the scene gives to all. `roots`:
/// as of load_scene(). Throws InputError naming `where` and field for what is no URDF of one object, and for a name
/// that is empty or taken.
Body read_object(const std::string& name, const std::string& urdf, const std::optional<RigidTransform>& X_WL,
                 const Scene& scene, const std::vector<std::string>& roots, const std::string& where);

/// Gives a movable body the mass `mass` [kg] ≥ 0, distributed as it is; a body without mass gets that of its shapes.
/// Throws InputError naming `where` for one without mass and without volume.
void set_mass(Body& body, double mass, const std::string& where);

/// Writes the scene to the URDF `path`, which ends in .urdf, and the YAML beside it; both beside and then renamed.
/// Links on fixed joints are one link then, meshes are named where they lie. What `load_scene` reads from there are the
/// same bodies, materials, targets and settings, to rounding. Returns the path of the URDF. Throws InputError where
/// `path` is in none of `roots` and no ROS package (no `roots`: anywhere), or cannot be written.
std::string save_scene(const Scene& scene, const std::string& path, const std::vector<std::string>& roots = {});

}  // namespace spring_workbench::scene
