#pragma once

#include <string>

namespace spring_workbench::validation {

/// Replaces every control character by a space, for external text in a message.
std::string one_line(std::string text);

}  // namespace spring_workbench::validation
