#pragma once

#include <string>

#include "spring_workbench/validation/number_rule.h"

namespace spring_workbench::validation {

/// The element of a list that is not empty. Throws InputError, with `key` for its name, if there is none of that index.
template <typename List>
auto& element(List& list, std::size_t index, const char* key) {
  if (index < list.size()) return list[index];
  refuse("", key, std::to_string(index), "an integer between 0 and " + std::to_string(list.size() - 1));
}

}  // namespace spring_workbench::validation
