#pragma once

#include <stdexcept>
#include <string>

namespace spring_workbench::validation {

/// Invalid input. The message is one line with place, field, value and rule, e.g. "scene.yaml:4: objects.mug.friction:
/// invalid value '-1': expected a number >= 0". The place is a file with its line, a service or the like; an argument
/// of a function of this library has none, but a pose is named by its time. A call that throws it changes nothing,
/// unless it says otherwise.
class InputError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace spring_workbench::validation
