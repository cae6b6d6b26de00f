#pragma once

#include <string>

namespace spring_workbench::validation {

/// The text with a space for every byte that ends a line or controls a terminal otherwise: text from outside in a
/// message.
std::string one_line(std::string text);

}  // namespace spring_workbench::validation
