#pragma once

#include <cstddef>

// The constants of the module: unit, what changing one does, and the test that notices.

namespace spring_workbench::config {

/// [bytes] of a value in a message; longer ones are cut. `YamlFields.LongValuesAreCutInMessages`
constexpr std::size_t longest_value = 80;
/// lists and maps in each other; more are refused, as are those that an alias makes endless.
/// `LoadYamlFile.RefusesWhatAliasesMakeEndlessOrImmense`
constexpr int most_deep = 100;
/// of a file, aliases followed; more are refused. `LoadYamlFile.RefusesWhatAliasesMakeEndlessOrImmense`
constexpr long most_values = 1000000;

}  // namespace spring_workbench::config
