#pragma once

#include <cstddef>

// Each with its unit, what changing it does, and the test that notices (scripts/mutate).

namespace spring_workbench::config {

/// [bytes] of a value in a message; longer ones are cut. Test: YamlFields.LongValuesAreCutInMessages.
constexpr std::size_t longest_value = 80;
/// Lists and maps in each other; more are refused, as are those that an alias makes endless. Test:
/// LoadYamlFile.RefusesWhatAliasesMakeEndlessOrImmense.
constexpr int most_deep = 100;
/// Of a file, aliases followed; more are refused. Test: LoadYamlFile.RefusesWhatAliasesMakeEndlessOrImmense.
constexpr long most_values = 1000000;

}  // namespace spring_workbench::config
