#pragma once

#include <algorithm>
#include <ctime>
#include <limits>

namespace spring_workbench::benchmark {

/// Processor time of this thread [ns].
inline double thread_nanoseconds() {
  timespec t{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
  return 1e9 * static_cast<double>(t.tv_sec) + static_cast<double>(t.tv_nsec);
}

/// Least time of a call [ns], told which of `calls` it is, over many short runs, fewer of long ones.
template <typename Call>
double least_nanoseconds(int calls, Call&& call) {
  constexpr int most_runs = 40, least_runs = 3;
  constexpr double enough = 1e8;  // [ns] in all
  double best = std::numeric_limits<double>::infinity(), spent = 0.0;
  for (int run = 0; run < least_runs || (run < most_runs && spent < enough); ++run) {
    const double begin = thread_nanoseconds();
    for (int i = 0; i < calls; ++i) call(i);
    const double time = thread_nanoseconds() - begin;
    best = std::min(best, time / calls);
    spent += time;
  }
  return best;
}

}  // namespace spring_workbench::benchmark
