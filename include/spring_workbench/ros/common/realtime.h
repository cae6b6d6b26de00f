#pragma once

namespace spring_workbench::ros_common {

/// Gives the calling thread this priority, 1 … 99, before all threads without one (SCHED_FIFO); does nothing for 0.
/// Where the system does not permit it, says once what would, and the thread goes on as it was. Returns the priority
/// that the thread has then.
int take_realtime_priority(int priority);

}  // namespace spring_workbench::ros_common
