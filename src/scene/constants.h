#pragma once

#include <cstddef>
#include <cstdint>

// Each with its unit, what changing it does, and the test that notices (scripts/mutate).

namespace spring_workbench::scene {

/// [bytes] of a file that a scene names; a larger one is refused. Test: LoadScene.RefusesHostileFiles.
constexpr std::uintmax_t most_bytes = 256u << 20;
/// Of a mesh; more are refused. Test: LoadScene.MoreThanAMillionTrianglesAreRefused.
constexpr std::size_t most_triangles = 1000000;
/// Of all meshes of a scene; more are refused. Test: LoadScene.AScenesMeshesHaveABudget.
constexpr std::size_t most_scene_triangles = 2000000;
/// [s] of the processor for reading all meshes of a scene; more is refused. Test: LoadScene.AScenesMeshesHaveABudget at
/// 0.001.
constexpr double most_scene_time = 60.0;
/// [s] of the processor for reading a mesh; longer ones are refused. Test: none: no value tried makes one fail.
constexpr double most_mesh_time = 30.0;
/// [bytes] for reading a mesh; what needs more is refused. Test: LoadScene.RefusesHostileMeshes at 21474836480.
constexpr std::uint64_t most_mesh_memory = std::uint64_t{2} << 30;
/// XML elements in each other, of which a URDF has six; more are refused. Test: LoadScene.RefusesHostileFiles at 6400.
constexpr int most_nesting = 64;
/// Of a URDF: its root and ten thousand more. A chain of them is walked by recursion, so that more would end the stack.
/// Test: LoadScene.RefusesHostileFiles.
constexpr std::size_t most_links = 10001;
/// Elements from which a child process tries whether TinyXML's recursion gets through. Larger: a deep file may crash;
/// smaller: small files cost a process. Test: LoadScene.RefusesHostileFiles at 1e9.
constexpr int tried_from = 500;
/// Folders below one of ROS_PACKAGE_PATH in which a package is looked for. Test:
/// LoadScene.PackagesAreFoundByTheFinderAndInRosPackagePath.
constexpr int package_depth = 3;
/// [kg] of a body; a larger one is refused. Test: LoadScene.MassThatIsNotPositiveComesFromTheShapeOrIsRefused at 0.
constexpr double most_mass = 1e12;
/// Of an inertia's figures as people write them; what is wrong by more is mended. Test:
/// LoadScene.TheRadiusOfGyrationMayReachTheShapesEndAndNoFurther at 0.1.
constexpr double inertia_rounding = 1e-6;

}  // namespace spring_workbench::scene
