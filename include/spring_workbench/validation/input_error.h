#pragma once

#include <stdexcept>
#include <string>

namespace spring_workbench::validation {

/// Invalid input. The message is one line: place (file and line, service …; none for an argument of this library),
/// field, rule and value, e.g. "scene.yaml:4: gravity: must be a number between 0 and 1000, got -3".
class InputError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace spring_workbench::validation
