#pragma once

#include <ctime>

namespace spring_workbench::benchmark {

/// Processor time of this thread [s].
inline double processor_time() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

}  // namespace spring_workbench::benchmark
