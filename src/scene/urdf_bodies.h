#pragma once

#include <functional>
#include <string>
#include <vector>

#include "mesh_file.h"
#include "spring_workbench/scene/scene.h"
#include "urdf_file.h"

namespace spring_workbench::scene {

/// Returns the material of the body with this name.
using MaterialOf = std::function<Material(const std::string& body)>;

/// Whether the root is the bench itself (`world` or `workbench`) rather than an object.
bool is_bench_scene(const UrdfFile& file);

/// The bodies of a URDF with its root link at `X_WR`. Links connected by fixed joints form one body; all other joints
/// except `floating` are fixed at zero. In a bench scene, each link attached to the root is a body of its own; in an
/// object, the root is the first body, which is movable if it has mass. Appends warnings. Throws InputError for what
/// cannot be repaired.
std::vector<Body> build_bodies(const UrdfFile& file, const RigidTransform& X_WR, const MaterialOf& material_of,
                               MeshCache& meshes, std::vector<std::string>& warnings);

}  // namespace spring_workbench::scene
