#include "spring_workbench/ros/common/realtime.h"

#include <pthread.h>
#include <ros/console.h>
#include <sched.h>

#include <cstring>

namespace spring_workbench::ros_common {

int take_realtime_priority(int priority) {
  if (priority == 0) return 0;
  sched_param wanted{};
  wanted.sched_priority = priority;
  const int error = pthread_setschedparam(pthread_self(), SCHED_FIFO, &wanted);
  if (error == 0) return priority;
  ROS_WARN_STREAM("realtime_priority: " << priority << " is not permitted (" << std::strerror(error)
                                        << "), so the loop runs without it; a line 'USER - rtprio " << priority
                                        << "' in /etc/security/limits.conf permits it");
  return 0;
}

}  // namespace spring_workbench::ros_common
