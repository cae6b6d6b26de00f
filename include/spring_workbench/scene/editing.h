#pragma once

#include <optional>
#include <string>
#include <vector>

#include "spring_workbench/scene/scene.h"

namespace spring_workbench::scene {

/// Reads a body called `name` from an object's own URDF, a package:// URI or a path, absolute or relative to the
/// scene's folder. Its link frame is at `X_WL`; without that, it lies on the bench at x = y = 0. It has the scene's
/// default materials. `roots`: as in load_scene(). Throws InputError naming `where` and field if `urdf` is not the URDF
/// of one object, or if the name is empty or taken.
Body read_object(const std::string& name, const std::string& urdf, const std::optional<RigidTransform>& X_WL,
                 const Scene& scene, const std::vector<std::string>& roots, const std::string& where);

/// A movable body by its name. Throws InputError naming `where` and `key`.
std::size_t movable_body(const Scene& scene, const std::string& name, const std::string& where, const std::string& key);

/// Gives a movable body the mass `mass` [kg] ≥ 0, distributed as it is; a body without mass gets that of its shapes.
/// Throws InputError naming `where` for one without mass and without volume.
void set_mass(Body& body, double mass, const std::string& where);

/// Writes the scene to the URDF `path`, which ends in .urdf, and the YAML beside it; both first under temporary names,
/// which are then renamed.
/// Links on fixed joints are one link then, meshes are named where they lie. What `load_scene` reads from there are the
/// same bodies, materials, targets and settings, to rounding. Returns the path of the URDF. Throws InputError where
/// `path` is in none of `roots` and no ROS package (no `roots`: anywhere), or cannot be written.
std::string save_scene(const Scene& scene, const std::string& path, const std::vector<std::string>& roots = {});

}  // namespace spring_workbench::scene
