#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "benchmark/progress.h"
#include "benchmark/row_text.h"

namespace spring_workbench::benchmark {

/// One of `count` parts into which the work of a report is divided.
struct Shard {
  std::size_t index = 1;  ///< starting at 1
  std::size_t count = 1;
};

/// Results of a unit of work: a line for each row, its processor time, and its origin for messages.
struct UnitRows {
  std::vector<std::string> lines;
  double processor = 0.0;  ///< [s]
  std::string where;
};
using RowsByUnit = std::map<std::string, UnitRows>;

/// Processor time of a unit of work.
struct UnitTime {
  std::string part, unit;
  double processor = 0.0;  ///< [s]
};

/// Processor time used so far by this process and its terminated children [s].
double processor_time_of_all();

/// The units of work of a report. Each has a unique name and a number in its part of the report; units with the same
/// number belong to the same shard. They are measured here (all of them, or those of one shard), or have been measured
/// by shards.
class Units {
 public:
  /// This shard takes every N-th number or, if there is a folder `queue`, the numbers that no other shard with the same
  /// folder has taken (there is a file in it for each number). The folder must be empty when the first shard starts.
  Units(Progress& progress, Shard shard, std::string queue = {})
      : progress_(progress), shard_(shard), queue_(std::move(queue)) {}
  Units(Progress& progress, RowsByUnit measured) : progress_(progress), merging_(true), rows_(std::move(measured)) {}

  /// Starts the part of this name, with new numbering.
  void begin(const std::string& part);

  /// The rows of a unit: those of `measure()`, those that a shard has measured, or none if it belongs to another shard.
  /// Throws InputError if no shard has measured it, or if its rows are not of this type.
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

  /// The results measured here; when merging, those that have not been requested.
  const RowsByUnit& kept() const { return rows_; }
  /// Times of the units measured here or, when merging, requested.
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
  std::map<std::size_t, bool> mine_;  ///< for requested numbers of the part, whether they are this shard's
  RowsByUnit rows_;
  std::vector<UnitTime> times_;
};

}  // namespace spring_workbench::benchmark
