#pragma once

#include <functional>
#include <string>
#include <vector>

#include "mesh_file.h"
#include "spring_workbench/scene/scene.h"
#include "urdf_file.h"

namespace spring_workbench::scene {

/// The material of the body with this name.
using MaterialOf = std::function<Material(const std::string& body)>;

/// Whether the root is the bench itself (`world` or `workbench`) rather than an object.
bool is_bench_scene(const UrdfFile& file);

/// The bodies of a URDF with its root link at `X_WR`. Links on fixed joints are one body; other joints but `floating`
/// are held at zero. Of a bench scene, a link on the root is a body of its own; of an object, the root is the first
/// body, which is movable when it carries mass. Warnings are appended; throws InputError for what cannot be mended.
std::vector<Body> build_bodies(const UrdfFile& file, const RigidTransform& X_WR, const MaterialOf& material_of,
                               MeshCache& meshes, std::vector<std::string>& warnings);

}  // namespace spring_workbench::scene
