#pragma once

#include <limits>
#include <string>
#include <vector>

#include "spring_workbench/validation/input_error.h"

namespace spring_workbench::validation {

/// Rule for the numbers that a field accepts. NaN is never allowed.
struct NumberRule {
  double min = -std::numeric_limits<double>::max();
  double max = std::numeric_limits<double>::max();
  bool min_allowed = true;        ///< false: must be greater than `min`
  bool infinity_allowed = false;  ///< true: `.inf` is allowed although it is greater than `max`
  const char* unit = "";          ///< unit of the numbers, for messages; "" or "–": they have none

  bool allows(double value) const;
  /// E.g. "a number > 0", "a number between 0 and 1 s"; "a finite number > 0" if `value`, which was given, is not
  /// finite.
  std::string text(double value = 0.0) const;
  /// The same rule for numbers with this unit, which must outlive it.
  NumberRule in(const char* unit_of_numbers) const;
};
inline NumberRule any_number() { return {}; }
inline NumberRule positive() { return {0.0, std::numeric_limits<double>::max(), false, false}; }
inline NumberRule not_negative() { return {0.0, std::numeric_limits<double>::max(), true, false}; }
inline NumberRule positive_or_infinite() { return {0.0, std::numeric_limits<double>::max(), false, true}; }
inline NumberRule between(double min, double max) { return {min, max, true, false}; }

/// A number as short as possible, with at most 12 digits; 1e-6 and 1e9 without padding zeros.
std::string number_text(double value);

/// Beginning of a message: "<where>: <key>: ", or "<key>: " if `where` is empty, as for an argument of the library.
std::string prefix(const std::string& where, const std::string& key);

/// The message "<where>: <key>: invalid value '<value>': expected <rule>", in one line; see prefix().
std::string invalid_value(const std::string& where, const std::string& key, const std::string& value,
                          const std::string& rule);

/// Throws InputError(invalid_value()).
[[noreturn]] void refuse(const std::string& where, const std::string& key, const std::string& value,
                         const std::string& rule);
/// The same if there is no value to quote: throws InputError("<where>: <key>: expected <rule>").
[[noreturn]] void refuse(const std::string& where, const std::string& key, const std::string& rule);
/// If no value is wrong, or no rule says why: throws InputError("<where>: <key>: <reason>").
[[noreturn]] void refuse_because(const std::string& where, const std::string& key, const std::string& reason);
/// Throws InputError("<where>: missing required key <key>: <rule>"), or, for an option of the command line (`--name`),
/// InputError("missing required option <key>: <rule>").
[[noreturn]] void refuse_missing(const std::string& where, const std::string& key, const std::string& rule);

/// Throws (see `refuse`) unless the rule allows `value`.
void check_number(const std::string& where, const std::string& key, double value, const NumberRule& rule);

/// "a, b, c"
std::string join(const std::vector<std::string>& words, const std::string& separator = ", ");

}  // namespace spring_workbench::validation
