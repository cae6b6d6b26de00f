// Each with its unit, the effect of a change, and the test that detects it (scripts/mutate).
#pragma once

#include <cstddef>

namespace spring_workbench::validation {

/// Letters to change up to which an unknown key counts as a misspelt one. Larger: a key that means something else is
/// taken for it. Test: UnknownKey.IsComparedWithTheNearestOfManyKeys at 6.
constexpr std::size_t max_edits = 2;

/// Number of keys up to which a message lists all of them. Larger: the line fills the terminal. Test:
/// UnknownKey.IsComparedWithTheNearestOfManyKeys at 12.
constexpr std::size_t max_listed_keys = 8;

}  // namespace spring_workbench::validation
