#pragma once

#include <map>
#include <string>

namespace spring_workbench::validation {

/// Settings and message fields that were renamed before the first release: old name → new name. Code that finds an old
/// name (in a file, on the parameter server or in a bag) reports the new one.
const std::map<std::string, std::string>& renamed();

/// The same for the values of a setting; refuse() reports the new one.
const std::map<std::string, std::string>& renamed_values();

/// Returns "unknown key; it is now called X" for a renamed key, otherwise "unknown key; known keys are `known`".
std::string unknown_key(const std::string& key, const std::string& known);

}  // namespace spring_workbench::validation
