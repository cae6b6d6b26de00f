#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "benchmark/progress.h"
#include "benchmark/row_text.h"

namespace spring_workbench::benchmark {

/// One of `count` parts that a report's work is dealt to.
struct Shard {
  std::size_t index = 1;  ///< from 1 on
  std::size_t count = 1;
};

/// What came out of a unit of work: a line for each row, what it took, and where it was read, for messages.
struct UnitRows {
  std::vector<std::string> lines;
  double processor = 0.0;  ///< [s]
  std::string where;
};
using RowsByUnit = std::map<std::string, UnitRows>;

/// What a unit of work took.
struct UnitTime {
  std::string part, unit;
  double processor = 0.0;  ///< [s]
};

/// Processor time that this process, its threads and those of its children that have ended have used so far [s].
double processor_time_of_all();

/// The units of work that a report is made of. Each has a name that no other has, and a number in its part of the
/// report: those of the same number are one shard's. They are all measured here, or those of one shard are, or they
/// have been measured by shards.
class Units {
 public:
  /// Every N-th number is this shard's or, if there is a folder `queue`, what no other shard that has the same folder
  /// took before: a file in it for each number. The folder must be empty when the first of them begins.
  Units(Progress& progress, Shard shard, std::string queue = {})
      : progress_(progress), shard_(shard), queue_(std::move(queue)) {}
  Units(Progress& progress, RowsByUnit measured) : progress_(progress), merging_(true), rows_(std::move(measured)) {}

  /// What follows is of the part of this name, and numbered anew.
  void begin(const std::string& part);

  /// The rows of a unit: those of `measure()`, those that a shard has measured, or none where it is another shard's.
  /// Throws InputError where no shard has it, or its rows are none of these.
  template <typename Row, typename Measure>
  std::vector<Row> rows(std::size_t number, const std::string& name, Measure&& measure) {
    std::vector<Row> rows;
    if (merging_) {
      const UnitRows unit = take(name);
      for (const std::string& line : unit.lines) rows.push_back(row_from_text<Row>(line, unit.where));
    } else if (is_mine(number)) {
      progress_.next(name);
      const double begun = processor_time_of_all();
      rows = measure();
      keep(name, rows, processor_time_of_all() - begun);
    } else {
      progress_.next("another shard's: " + name);
    }
    return rows;
  }

  Progress& progress() { return progress_; }

  /// What has been measured here; when merging what nobody has asked for.
  const RowsByUnit& kept() const { return rows_; }
  /// Of what has been measured here or, when merging, asked for.
  const std::vector<UnitTime>& times() const { return times_; }

 private:
  bool is_mine(std::size_t number);
  template <typename Row>
  void keep(const std::string& name, const std::vector<Row>& rows, double processor) {
    UnitRows& unit = rows_[name];
    for (const Row& row : rows) unit.lines.push_back(row_text(row));
    unit.processor = processor;
    times_.push_back({part_, name, processor});
  }
  UnitRows take(const std::string& name);

  Progress& progress_;
  Shard shard_;
  std::string queue_;
  bool merging_ = false;
  std::string part_;
  std::map<std::size_t, bool> mine_;  ///< numbers of the part that have been asked for
  RowsByUnit rows_;
  std::vector<UnitTime> times_;
};

}  // namespace spring_workbench::benchmark
