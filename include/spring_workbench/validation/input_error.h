#pragma once

#include <stdexcept>
#include <string>

namespace spring_workbench::validation {

/// Invalid input. The message is one line: place (file and line, service …; none for an argument of this library),
/// field, value and rule, e.g. "scene.yaml:4: gravity: invalid value '-3': expected a number >= 0 m/s²".
class InputError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace spring_workbench::validation
