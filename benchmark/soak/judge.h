#pragma once

#include <iostream>

namespace spring_workbench::benchmark {

/// Says whether a law holds; 1 where it does not.
inline int judge(bool law, const char* text) {
  std::cout << (law ? "PASS  " : "FAIL  ") << text << '\n';
  return law ? 0 : 1;
}

}  // namespace spring_workbench::benchmark
