#pragma once

#include <unistd.h>

#include <fstream>

namespace spring_workbench::benchmark {

/// Resident memory of this process [bytes].
inline double resident_bytes() {
  std::ifstream file("/proc/self/statm");
  double total = 0.0, resident = 0.0;
  file >> total >> resident;
  return resident * static_cast<double>(sysconf(_SC_PAGESIZE));
}

}  // namespace spring_workbench::benchmark
