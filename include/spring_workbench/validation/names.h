#pragma once

#include <string>
#include <vector>

#include "spring_workbench/validation/number_rule.h"

namespace spring_workbench::validation {

/// Names of the values of an enum in files, parameters and services, in order. Each enum declares a `names_of(E)` next
/// to it.
template <typename E>
std::vector<std::string> names() {
  return names_of(E{});
}

template <typename E>
std::string name_of(E value) {
  return names<E>().at(static_cast<std::size_t>(value));
}

/// Returns the value called `name`. Throws InputError naming `where` and `key` if there is none.
template <typename E>
E named(const std::string& name, const std::string& where, const std::string& key) {
  const std::vector<std::string> all = names<E>();
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (all[i] == name) return static_cast<E>(i);
  }
  refuse(where, key, name, "one of " + join(all));
}

}  // namespace spring_workbench::validation
