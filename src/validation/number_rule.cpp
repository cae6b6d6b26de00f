#include "spring_workbench/validation/number_rule.h"

#include <cmath>
#include <sstream>

#include "spring_workbench/validation/one_line.h"
#include "spring_workbench/validation/renamed.h"

namespace spring_workbench::validation {
namespace {

/// Formats a value with as few digits as needed, at most 12; 1e-6 and 1e9 without padding zeros.
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

}  // namespace

bool NumberRule::allows(double value) const {
  if (std::isnan(value)) return false;
  if (std::isinf(value)) return infinity_allowed && value > 0.0;
  return (min_allowed ? value >= min : value > min) && value <= max;
}

std::string NumberRule::text() const {
  constexpr double unbounded = std::numeric_limits<double>::max();
  if (min > -unbounded && max < unbounded) return "a number between " + number_text(min) + " and " + number_text(max);
  std::string text = "a finite number";
  if (min > -unbounded) {
    text += (min_allowed ? " >= " : " > ") + number_text(min);
  } else if (max < unbounded) {
    text += " <= " + number_text(max);
  }
  return infinity_allowed ? text + ", or .inf" : text;
}

std::string prefix(const std::string& where, const std::string& key) {
  return (where.empty() ? "" : where + ": ") + key + ": ";
}

void refuse(const std::string& where, const std::string& key, const std::string& value, const std::string& rule) {
  const std::string place = prefix(where, key);
  if (value.empty()) throw InputError(one_line(place + "missing; give " + rule));
  const auto now = renamed_values().find(value);
  const std::string allowed = now == renamed_values().end() ? rule : now->second + ", which has replaced it";
  throw InputError(one_line(place + "must be " + allowed + ", got " + value));
}

void check_number(const std::string& where, const std::string& key, double value, const NumberRule& rule) {
  if (!rule.allows(value)) refuse(where, key, number_text(value), rule.text());
}

std::string join(const std::vector<std::string>& words, const std::string& separator) {
  std::string text;
  for (const std::string& word : words) text += (text.empty() ? "" : separator) + word;
  return text;
}

}  // namespace spring_workbench::validation
