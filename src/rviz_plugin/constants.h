#pragma once

#include <cstddef>

namespace spring_workbench::rviz_plugin {

// Each with its unit, the effect of a change, and the test that detects it (scripts/mutate).

/// Time without a message after which panel and fork report it [s]. If longer, a dead node seems alive. Test:
/// rviz_recovery_test.py::test_fork_of_the_display.
constexpr double longest_silence = 2.0;
/// Time until a change by the user shows in the received state [s]. If shorter, the control jumps back for a moment.
/// Test: none: appearance.
constexpr double settling = 0.7;
/// Time in which a cycle in the plot fades to the colour of the older ones [s]. Test: ErrorPlotTest.ADotFades.
constexpr double plot_fading = 10.0;
/// Number of positions of a logarithmic slider. If fewer, values are coarser. Test: none: appearance.
constexpr int slider_positions = 1000;
/// Time from closing rviz's windows until it exits without waiting for the ROS master [s]. If longer, rviz exits later
/// when the master hangs; if much shorter, it exits while it still frees resources. Test:
/// rviz_recovery_test.py::test_rviz_ends_while_the_master_hangs at 600.
constexpr double exit_timeout = 1.5;
/// Time for building shapes in each frame [s]. If longer, rviz stalls while a scene is built; if shorter, the scene is
/// complete later. Test: SceneObjectsTest.AFrameBuildsForAShortTime at 60.
constexpr double build_time = 0.005;
/// Number of corners of triangles in one piece of a mesh. If larger, a frame takes longer; if smaller, large meshes
/// have more pieces to draw. Test: SceneObjectsTest.AreBuiltInParts at 3000000.
constexpr std::size_t piece_corners = 30000;

}  // namespace spring_workbench::rviz_plugin
