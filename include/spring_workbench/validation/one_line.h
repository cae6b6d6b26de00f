#pragma once

#include <string>

namespace spring_workbench::validation {

/// The text with a space for every control character, for text from outside in a message.
std::string one_line(std::string text);

}  // namespace spring_workbench::validation
