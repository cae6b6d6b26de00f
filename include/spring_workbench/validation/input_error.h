#pragma once

#include <stdexcept>
#include <string>

namespace spring_workbench::validation {

/// Invalid input (a file, a parameter, a command line, a service call). The message is one line with the place, the
/// field, the rule and the value given, e.g. "scene.yaml:4: gravity: must be a number between 0 and 1000, got -3".
class InputError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace spring_workbench::validation
