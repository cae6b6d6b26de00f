#pragma once

#include <fstream>
#include <string>

namespace spring_workbench::benchmark {

/// Resident memory of this process that it has allocated [bytes]: without the pages of program files, which come in as
/// code runs for the first time.
inline double resident_bytes() {
  std::ifstream file("/proc/self/status");
  std::string word;
  while (file >> word && word != "RssAnon:") {
  }
  double kilobytes = 0.0;
  file >> kilobytes;
  return 1024.0 * kilobytes;
}

}  // namespace spring_workbench::benchmark
