#pragma once

namespace spring_workbench::ros_common {

/// From now on a thread of its own writes what is logged to the terminal: one that does not read (Ctrl-S, a pager, a
/// pipe that is full) holds no other thread up. If more is logged meanwhile than the queue takes, the rest is lost, and
/// a line says how many lines there were. To be called once, before other threads log.
void log_in_background();

/// Whether the standard error output takes a line at once.
bool error_output_takes_more();

}  // namespace spring_workbench::ros_common
