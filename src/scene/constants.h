#pragma once

#include <cstddef>
#include <cstdint>

// Each with its unit, the effect of a change, and the test that detects it (scripts/mutate).

namespace spring_workbench::scene {

/// Maximum size of a file that a scene refers to [bytes]. Test: LoadScene.RefusesHostileFiles.
constexpr std::uintmax_t max_bytes = 256u << 20;
/// Maximum number of triangles of a mesh. Test: LoadScene.MoreThanAMillionTrianglesAreRefused.
constexpr std::size_t max_triangles = 1000000;
/// Maximum number of triangles of all meshes of a scene, including those of added objects. Test:
/// LoadScene.AScenesMeshesHaveABudget.
constexpr std::size_t max_scene_triangles = 2000000;
/// Maximum processor time for reading all meshes of a scene [s]. Test: LoadScene.AScenesMeshesHaveABudget at 0.001.
constexpr double max_scene_time = 60.0;
/// Maximum processor time for reading one mesh [s]. Test: none: no value tried makes one fail.
constexpr double max_mesh_time = 30.0;
/// Maximum memory for reading one mesh [bytes]. Test: LoadScene.RefusesHostileMeshes at 21474836480.
constexpr std::uint64_t max_mesh_memory = std::uint64_t{2} << 30;
/// Maximum nesting depth of XML elements; a URDF has six. Test: LoadScene.RefusesHostileFiles at 6400.
constexpr int max_nesting = 64;
/// Maximum number of links of a URDF: its root and ten thousand more. A chain of links is walked recursively; more
/// would overflow the stack. Test: LoadScene.RefusesHostileFiles.
constexpr std::size_t max_links = 10001;
/// Number of XML elements above which a file is first parsed in a child process, because TinyXML's recursion may
/// overflow the stack. If larger, a deeply nested file may crash; if smaller, even small files cost a process. Test:
/// LoadScene.RefusesHostileFiles at 1e9.
constexpr int elements_parsed_in_child = 500;
/// Depth to which packages are searched below an entry of ROS_PACKAGE_PATH. Test:
/// LoadScene.PackagesAreFoundByTheFinderAndInRosPackagePath.
constexpr int package_depth = 3;
/// Relative rounding error of an inertia written by hand; an inertia that is inconsistent by more is repaired. Test:
/// LoadScene.TheRadiusOfGyrationMayReachTheShapesEndAndNoFurther at 0.1.
constexpr double inertia_rounding = 1e-6;

}  // namespace spring_workbench::scene
