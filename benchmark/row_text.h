#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <type_traits>

#include "spring_workbench/validation/number_rule.h"

namespace spring_workbench::benchmark {

/// Writes and reads rows as lines of tab-separated fields. Numbers are restored bit-identically. Each row type has a
/// function `each_field(row, fields)`, which calls `fields(…)` with all its fields; strings must not contain tabs or
/// line breaks.
class FieldWriter {
 public:
  template <typename... Fields>
  void operator()(const Fields&... fields) {
    (put(fields), ...);
  }
  const std::string& line() const { return line_; }

 private:
  template <typename Field>
  void put(const Field& field) {
    if (!first_) line_ += '\t';
    first_ = false;
    if constexpr (std::is_same_v<Field, std::string>) {
      line_ += field;
    } else if constexpr (std::is_floating_point_v<Field>) {
      char text[40];
      std::snprintf(text, sizeof(text), "%a", field);
      line_ += text;
    } else {
      line_ += std::to_string(static_cast<long>(field));
    }
  }

  std::string line_;
  bool first_ = true;
};

class FieldReader {
 public:
  /// `where` names the line in messages.
  FieldReader(std::string line, std::string where) : line_(std::move(line)), where_(std::move(where)) {}

  /// Throws InputError if the number of fields is wrong, or if a field that should be a number is not.
  template <typename... Fields>
  void operator()(Fields&... fields) {
    (get(fields), ...);
    if (at_ <= line_.size()) wrong(line_);
  }

 private:
  template <typename Field>
  void get(Field& field) {
    if (at_ > line_.size()) wrong(line_);
    const std::size_t end = std::min(line_.find('\t', at_), line_.size());
    const std::string text = line_.substr(at_, end - at_);
    at_ = end + 1;
    char* rest = nullptr;
    if constexpr (std::is_same_v<Field, std::string>) {
      field = text;
      return;
    } else if constexpr (std::is_floating_point_v<Field>) {
      field = std::strtod(text.c_str(), &rest);
    } else {
      field = static_cast<Field>(std::strtol(text.c_str(), &rest, 10));
    }
    if (text.empty() || *rest != '\0') wrong(text);
  }
  [[noreturn]] void wrong(const std::string& value) const {
    validation::refuse(where_, "row", value, "a row that this program writes");
  }

  std::string line_, where_;
  std::size_t at_ = 0;
};

template <typename Row>
std::string row_text(Row row) {
  FieldWriter fields;
  each_field(row, fields);
  return fields.line();
}

template <typename Row>
Row row_from_text(const std::string& line, const std::string& where) {
  Row row;
  FieldReader fields(line, where);
  each_field(row, fields);
  return row;
}

}  // namespace spring_workbench::benchmark
