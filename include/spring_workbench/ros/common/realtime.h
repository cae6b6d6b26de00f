#pragma once

namespace spring_workbench::ros_common {

/// Gives the calling thread this real-time priority (SCHED_FIFO), 1 … 99; does nothing for 0. If the system does not
/// permit it, logs one warning that says how to permit it, and leaves the priority unchanged. Returns the priority that
/// the thread then has.
int take_realtime_priority(int priority);

}  // namespace spring_workbench::ros_common
