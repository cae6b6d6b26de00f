#pragma once

#include <optional>
#include <string>
#include <vector>

#include "spring_workbench/scene/scene.h"

namespace spring_workbench::scene {

/// Reads a body called `name` from an object's own URDF, a package:// URI or a path, absolute or relative to the
/// scene's folder. Its link frame is at `X_WL`; if that is absent, the body stands on the bench at x = y = 0. It has
/// the scene's default material. `roots`: as in load_scene(). Throws InputError naming `where` and the field if `urdf`
/// is not the URDF of exactly one object, if the name is empty or already used, or if the scene would have too many
/// triangles.
Body read_object(const std::string& name, const std::string& urdf, const std::optional<RigidTransform>& X_WL,
                 const Scene& scene, const std::vector<std::string>& roots, const std::string& where);

/// Returns the index of the movable body called `name`. Throws InputError naming `where` and `key` if there is none.
std::size_t movable_body(const Scene& scene, const std::string& name, const std::string& where, const std::string& key);

/// Sets the mass of a movable body to `mass` [kg] ≥ 0 and scales its inertia accordingly; a massless body gets the mass
/// distribution of its shapes. Throws InputError naming `where` for a body without mass and without volume.
void set_mass(Body& body, double mass, const std::string& where);

/// Writes the scene to the URDF `path`, which must end in .urdf, and to the YAML file of the same name next to it; both
/// are written under temporary names and then renamed. Links joined by fixed joints become one link; meshes are not
/// copied, but referred to by their paths. load_scene() reads back the same bodies, materials, targets and settings, up
/// to rounding. Returns the path of the URDF. Throws InputError if `path` cannot be written, or is neither in one of
/// `roots` nor in a ROS package (with no `roots`, any path is allowed).
std::string save_scene(const Scene& scene, const std::string& path, const std::vector<std::string>& roots = {});

}  // namespace spring_workbench::scene
