#pragma once

#include <cstddef>

// Each with its unit, the effect of a change, and the test that detects it (scripts/mutate).

namespace spring_workbench::config {

/// Maximum length of a value in a message [bytes]; longer ones are truncated. Test:
/// YamlFields.LongValuesAreCutInMessages.
constexpr std::size_t longest_value = 80;
/// Maximum nesting depth of lists and maps. A deeper file, or one that an alias makes endless, is refused. Test:
/// LoadYamlFile.RefusesEndlessOrHugeAliases.
constexpr int max_nesting_depth = 100;
/// Maximum number of values in a file, with aliases expanded. A larger file is refused. Test:
/// LoadYamlFile.RefusesEndlessOrHugeAliases.
constexpr long max_values = 1000000;

}  // namespace spring_workbench::config
