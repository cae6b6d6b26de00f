#pragma once

#include <iostream>

namespace spring_workbench::benchmark {

/// Prints whether a requirement holds; returns 1 if it does not.
inline int judge(bool law, const char* text) {
  std::cout << (law ? "PASS  " : "FAIL  ") << text << '\n';
  return law ? 0 : 1;
}

}  // namespace spring_workbench::benchmark
