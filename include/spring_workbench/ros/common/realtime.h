#pragma once

namespace spring_workbench::ros_common {

/// Gives the calling thread this priority, 1 … 99, before all threads without one (SCHED_FIFO); does nothing for 0.
/// If the system does not permit it, one warning says how to permit it, and the thread keeps its priority. Returns the
/// priority that the thread then has.
int take_realtime_priority(int priority);

}  // namespace spring_workbench::ros_common
