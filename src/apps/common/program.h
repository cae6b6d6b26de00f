#pragma once

#include <algorithm>
#include <exception>
#include <iostream>
#include <string>

#include "spring_workbench/validation/input_error.h"

namespace spring_workbench {

/// Runs a program and turns what it throws into one line and an exit status: 0 done, 2 bad arguments or input, 1
/// failed.
template <typename Program>
int run_program(const std::string& name, Program&& program) {
  const auto end = [&](std::string line, int status) {
    std::replace(line.begin(), line.end(), '\n', ' ');
    std::cerr << name << ": " << line << std::endl;
    return status;
  };
  try {
    program();
    return 0;
  } catch (const validation::InputError& e) {
    return end(e.what(), 2);
  } catch (const std::exception& e) {
    return end(std::string("failed: ") + e.what(), 1);
  }
}

}  // namespace spring_workbench
