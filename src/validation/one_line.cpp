#include "spring_workbench/validation/one_line.h"

#include <algorithm>
#include <cctype>

namespace spring_workbench::validation {

std::string one_line(std::string text) {
  const auto controls = [](char c) { return std::iscntrl(static_cast<unsigned char>(c)) != 0; };
  std::replace_if(text.begin(), text.end(), controls, ' ');
  return text;
}

}  // namespace spring_workbench::validation
