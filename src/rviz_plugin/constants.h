#pragma once

namespace spring_workbench::rviz_plugin {

// Each with its unit, what changing it does, and the test that notices (scripts/mutate).

/// [s] without a message after which panel and fork report it. Longer: a dead node seems alive. Test:
/// rviz_recovery_test.py::test_fork_of_the_display.
constexpr double longest_silence = 2.0;
/// [s] until a change made by hand shows in the received state. Shorter: the control jumps back for a moment. Test:
/// none: a look.
constexpr double settling = 0.7;
/// [s] of cycles shown in the plot. Test: none: a look.
constexpr double kept_for = 10.0;
/// Number of positions of a logarithmic slider. Fewer: coarser values. Test: none: a look.
constexpr int slider_positions = 1000;
/// [s] from the end of rviz' windows until it ends without the ROS master's leave. Longer: with a master that hangs,
/// rviz is there for longer; much shorter: it ends while it still frees things. Test:
/// rviz_recovery_test.py::test_rviz_ends_while_the_master_hangs at 600.
constexpr double exit_patience = 5.0;

}  // namespace spring_workbench::rviz_plugin
