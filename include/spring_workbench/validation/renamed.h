#pragma once

#include <map>
#include <string>

namespace spring_workbench::validation {

/// Settings and message fields that were renamed before the first release: old name → new name. Who meets an old one,
/// in a file, on the parameter server or in a bag, says the new one.
const std::map<std::string, std::string>& renamed();

/// The same for words that a setting may be: refuse() says the new one.
const std::map<std::string, std::string>& renamed_values();

/// "unknown key; it is called X now" for a renamed key, else "unknown key; known are `known`".
std::string unknown_key(const std::string& key, const std::string& known);

}  // namespace spring_workbench::validation
