#pragma once

#include <stdexcept>
#include <string>

namespace spring_workbench::validation {

/// Bad input from outside (a file, a parameter, a command line, a service call). The message is one line that names the
/// place, the field, its value and what is allowed, e.g. "scene.yaml:4: gravity: -3 is not allowed: must be in [0,
/// 1e3]".
class InputError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace spring_workbench::validation
