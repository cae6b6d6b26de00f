#pragma once

#include <map>
#include <string>
#include <vector>

namespace spring_workbench::validation {

/// Settings and message fields that were renamed before the first release: old name → new name. Code that finds an old
/// name (in a file, on the parameter server or in a bag) reports the new one.
const std::map<std::string, std::string>& renamed();

/// Values of settings that were renamed: old value → new value; refuse() reports the new one.
const std::map<std::string, std::string>& renamed_values();

/// Returns what is wrong with a key that is not one of `known`: the new name of a renamed key, the nearest key of a
/// long list for a misspelt one, or otherwise the list.
std::string unknown_key(const std::string& key, const std::vector<std::string>& known);

}  // namespace spring_workbench::validation
