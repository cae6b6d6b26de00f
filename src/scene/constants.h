#pragma once

#include <cstddef>
#include <cstdint>

// Each with its unit, what changing it does, and the test that notices (scripts/mutate).

namespace spring_workbench::scene {

/// [bytes] of a file that a scene names; a larger one is refused. Test: LoadScene.RefusesHostileFiles.
constexpr std::uintmax_t most_bytes = 256u << 20;
/// Triangles of a mesh; more are refused. Test: LoadScene.MoreThanAMillionTrianglesAreRefused.
constexpr std::size_t most_triangles = 1000000;
/// Triangles of all meshes of a scene; more are refused. Test: LoadScene.AScenesMeshesHaveABudget.
constexpr std::size_t most_scene_triangles = 2000000;
/// [s] of processor time for reading all meshes of a scene; more is refused. Test: LoadScene.AScenesMeshesHaveABudget
/// at 0.001.
constexpr double most_scene_time = 60.0;
/// [s] of processor time for reading one mesh; more is refused. Test: none: no value tried makes one fail.
constexpr double most_mesh_time = 30.0;
/// [bytes] of memory for reading one mesh; more is refused. Test: LoadScene.RefusesHostileMeshes at 21474836480.
constexpr std::uint64_t most_mesh_memory = std::uint64_t{2} << 30;
/// Depth of nested XML elements, six in a URDF; more are refused. Test: LoadScene.RefusesHostileFiles at 6400.
constexpr int most_nesting = 64;
/// Links of a URDF: its root and ten thousand more. A chain of links is walked by recursion: more would overflow the
/// stack. Test: LoadScene.RefusesHostileFiles.
constexpr std::size_t most_links = 10001;
/// Number of XML elements from which a file is first parsed in a child process, because TinyXML's recursion may
/// overflow the stack. Larger: a deeply nested file may crash; smaller: small files cost a process. Test:
/// LoadScene.RefusesHostileFiles at 1e9.
constexpr int elements_parsed_in_child = 500;
/// Depth of the folders below an entry of ROS_PACKAGE_PATH in which a package is searched. Test:
/// LoadScene.PackagesAreFoundByTheFinderAndInRosPackagePath.
constexpr int package_depth = 3;
/// [kg] of a body; a larger mass is refused. Test: LoadScene.MassThatIsNotPositiveComesFromTheShapeOrIsRefused at 0.
constexpr double most_mass = 1e12;
/// Relative rounding of an inertia as people write it; an inertia that is wrong by more is repaired. Test:
/// LoadScene.TheRadiusOfGyrationMayReachTheShapesEndAndNoFurther at 0.1.
constexpr double inertia_rounding = 1e-6;

}  // namespace spring_workbench::scene
