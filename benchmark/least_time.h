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

/// Minimum time of a call [ns] over many short runs, fewer if a call takes long. `call` is given the index of the call,
/// less than `calls`.
template <typename Call>
double min_nanoseconds(int calls, Call&& call) {
  constexpr int max_runs = 40, min_runs = 3;
  constexpr double enough = 1e8;  // [ns] in all
  double best = std::numeric_limits<double>::infinity(), spent = 0.0;
  for (int run = 0; run < min_runs || (run < max_runs && spent < enough); ++run) {
    const double begin = thread_nanoseconds();
    for (int i = 0; i < calls; ++i) call(i);
    const double time = thread_nanoseconds() - begin;
    best = std::min(best, time / calls);
    spent += time;
  }
  return best;
}

}  // namespace spring_workbench::benchmark
