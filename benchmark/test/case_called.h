#pragma once

#include <stdexcept>
#include <string>

#include "benchmark/rod_case.h"

namespace spring_workbench::benchmark {

/// The synthetic case of this name, cut to `duration` [s].
inline RodCase case_called(const std::string& name, double duration) {
  for (RodCase one : synthetic_cases(false)) {
    if (one.name != name) continue;
    one.duration = duration;
    return one;
  }
  throw std::runtime_error("no case " + name);
}

}  // namespace spring_workbench::benchmark
