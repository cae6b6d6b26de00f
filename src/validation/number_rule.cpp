#include "spring_workbench/validation/number_rule.h"

#include <cmath>
#include <sstream>

#include "spring_workbench/validation/one_line.h"
#include "spring_workbench/validation/renamed.h"

namespace spring_workbench::validation {

std::string number_text(double value) {
  if (std::isnan(value)) return "nan";  // never "-nan"
  std::string text;
  for (const int digits : {6, 12}) {
    std::ostringstream out;
    out.precision(digits);
    out << value;
    text = out.str();
    if (double read = 0.0; std::istringstream(text) >> read && read == value) break;
  }
  const std::size_t e = text.find('e');
  if (e == text.npos) return text;
  if (text[e + 2] == '0') text.erase(e + 2, 1);
  if (text[e + 1] == '+') text.erase(e + 1, 1);
  return text;
}

bool NumberRule::allows(double value) const {
  if (std::isnan(value)) return false;
  if (std::isinf(value)) return infinity_allowed && value > 0.0;
  return (min_allowed ? value >= min : value > min) && value <= max;
}

std::string NumberRule::text(double value) const {
  constexpr double unbounded = std::numeric_limits<double>::max();
  const bool dimensionless = unit == std::string() || unit == std::string("–");
  const std::string with_unit = dimensionless ? "" : std::string(" ") + unit;
  if (min > -unbounded && max < unbounded)
    return "a number between " + number_text(min) + " and " + number_text(max) + with_unit;
  std::string text = std::isfinite(value) ? "a number" : "a finite number";
  if (min > -unbounded) {
    text += (min_allowed ? " >= " : " > ") + number_text(min) + with_unit;
  } else if (max < unbounded) {
    text += " <= " + number_text(max) + with_unit;
  } else if (!dimensionless) {
    text += " in" + with_unit;
  }
  return infinity_allowed ? text + ", or .inf" : text;
}

NumberRule NumberRule::in(const char* unit_of_numbers) const {
  NumberRule rule = *this;
  rule.unit = unit_of_numbers;
  return rule;
}

std::string prefix(const std::string& where, const std::string& key) {
  return (where.empty() ? "" : where + ": ") + key + ": ";
}

std::string invalid_value(const std::string& where, const std::string& key, const std::string& value,
                          const std::string& rule) {
  const auto now = renamed_values().find(value);
  const std::string allowed = now == renamed_values().end() ? rule : now->second + ", which has replaced it";
  return one_line(prefix(where, key) + "invalid value '" + value + "': expected " + allowed);
}

void refuse(const std::string& where, const std::string& key, const std::string& value, const std::string& rule) {
  throw InputError(invalid_value(where, key, value, rule));
}

void refuse(const std::string& where, const std::string& key, const std::string& rule) {
  throw InputError(one_line(prefix(where, key) + "expected " + rule));
}

void refuse_because(const std::string& where, const std::string& key, const std::string& reason) {
  throw InputError(one_line(prefix(where, key) + reason));
}

void refuse_missing(const std::string& where, const std::string& key, const std::string& rule) {
  if (key.rfind("--", 0) == 0) throw InputError(one_line("command line: missing required option " + key + ": " + rule));
  throw InputError(one_line((where.empty() ? "" : where + ": ") + "missing required key " + key + ": " + rule));
}

void check_number(const std::string& where, const std::string& key, double value, const NumberRule& rule) {
  if (!rule.allows(value)) refuse(where, key, number_text(value), rule.text(value));
}

std::string join(const std::vector<std::string>& words, const std::string& separator) {
  std::string text;
  for (const std::string& word : words) text += (text.empty() ? "" : separator) + word;
  return text;
}

}  // namespace spring_workbench::validation
