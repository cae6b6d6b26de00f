#pragma once

namespace spring_workbench::ros_common {

/// Writes log lines to the terminal from a separate thread from now on, so that a terminal that does not read (Ctrl-S,
/// a pager, a full pipe) blocks no other thread. Lines beyond the capacity of the queue are dropped, and a later line
/// reports how many. Call once, before other threads log.
void log_in_background();

/// Whether standard error can take a line without blocking.
bool error_output_takes_more();

}  // namespace spring_workbench::ros_common
