#pragma once

#include <cstddef>

// The constants of the module: unit, what changing one does, and the test that notices: "noticed by" was seen to fail
// with another value, "goes into" is by reading alone.

namespace spring_workbench::config {

/// [bytes] of a value in a message; longer ones are cut. Noticed by `YamlFields.LongValuesAreCutInMessages`.
constexpr std::size_t longest_value = 80;
/// Lists and maps in each other; more are refused, as are those that an alias makes endless. Noticed by
/// `LoadYamlFile.RefusesWhatAliasesMakeEndlessOrImmense`.
constexpr int most_deep = 100;
/// Of a file, aliases followed; more are refused. Noticed by `LoadYamlFile.RefusesWhatAliasesMakeEndlessOrImmense`.
constexpr long most_values = 1000000;

}  // namespace spring_workbench::config
