#pragma once

#include <stdexcept>
#include <string>

namespace spring_workbench::validation {

/// Bad input from outside (a file, a parameter, a command line, a service call). The message is one line that names the
/// place, the field, what is allowed and what was given, e.g. "scene.yaml:4: gravity: must be a number between 0 and
/// 1000, got -3".
class InputError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace spring_workbench::validation
