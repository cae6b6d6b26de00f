#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <vector>

#include "benchmark/progress.h"
#include "benchmark/row_text.h"

namespace spring_workbench::benchmark {

/// One of `count` parts that a report's work is dealt to.
struct Shard {
  std::size_t index = 1;  ///< from 1 on
  std::size_t count = 1;
};

/// What came out of a unit of work: a line for each row, and where it was read, for messages.
struct UnitRows {
  std::vector<std::string> lines;
  std::string where;
};
using RowsByUnit = std::map<std::string, UnitRows>;

/// The units of work that a report is made of. Each has a name that no other has. They are all measured here, or those
/// of one shard are, or they have been measured by shards.
class Units {
 public:
  Units(Progress& progress, Shard shard) : progress_(progress), shard_(shard) {}
  Units(Progress& progress, RowsByUnit measured) : progress_(progress), merging_(true), rows_(std::move(measured)) {}

  /// Whether units with this number are measured here.
  bool measured_here(std::size_t number) const { return !merging_ && number % shard_.count == shard_.index - 1; }

  /// The rows of a unit: those of `measure()`, those that a shard has measured, or none where it is another shard's.
  /// Throws InputError where no shard has it, or its rows are none of these.
  template <typename Row, typename Measure>
  std::vector<Row> rows(std::size_t number, const std::string& name, Measure&& measure) {
    std::vector<Row> rows;
    if (merging_) {
      const UnitRows unit = take(name);
      for (const std::string& line : unit.lines) rows.push_back(row_from_text<Row>(line, unit.where));
    } else if (measured_here(number)) {
      progress_.next(name);
      rows = measure();
      keep(name, rows);
    } else {
      progress_.next("another shard's: " + name);
    }
    return rows;
  }

  Progress& progress() { return progress_; }

  /// What has been measured here; when merging what nobody has asked for.
  const RowsByUnit& kept() const { return rows_; }

 private:
  template <typename Row>
  void keep(const std::string& name, const std::vector<Row>& rows) {
    std::vector<std::string>& lines = rows_[name].lines;
    for (const Row& row : rows) lines.push_back(row_text(row));
  }
  UnitRows take(const std::string& name);

  Progress& progress_;
  Shard shard_;
  bool merging_ = false;
  RowsByUnit rows_;
};

}  // namespace spring_workbench::benchmark
