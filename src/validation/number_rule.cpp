#include "spring_workbench/validation/number_rule.h"

#include <cmath>
#include <sstream>

#include "spring_workbench/validation/one_line.h"
#include "spring_workbench/validation/renamed.h"

namespace spring_workbench::validation {
namespace {

std::string number_text(double value) {
  if (std::isnan(value)) return "nan";  // without a sign
  std::ostringstream out;
  out.precision(12);
  out << value;
  return out.str();
}

}  // namespace

bool NumberRule::allows(double value) const {
  if (std::isnan(value)) return false;
  if (std::isinf(value)) return infinity_allowed && value > 0.0;
  return (min_allowed ? value >= min : value > min) && value <= max;
}

std::string NumberRule::text() const {
  constexpr double unbounded = std::numeric_limits<double>::max();
  std::string text = "a finite number";
  if (min > -unbounded && max < unbounded) {
    text += std::string(" in ") + (min_allowed ? "[" : "(") + number_text(min) + ", " + number_text(max) + "]";
  } else if (min > -unbounded) {
    text += (min_allowed ? " >= " : " > ") + number_text(min);
  } else if (max < unbounded) {
    text += " <= " + number_text(max);
  }
  return infinity_allowed ? text + ", or .inf" : text;
}

void refuse(const std::string& where, const std::string& key, const std::string& value, const std::string& rule) {
  const std::string given = value.empty() ? "(nothing)" : value;
  const auto now = renamed_values().find(value);
  const std::string allowed = now == renamed_values().end() ? rule : now->second + ", which has taken its place";
  throw InputError(one_line(where + ": " + key + ": " + given + " is not allowed: must be " + allowed));
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
