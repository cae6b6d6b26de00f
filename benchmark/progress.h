#pragma once

#include <chrono>
#include <cstddef>
#include <mutex>
#include <ostream>
#include <string>

namespace spring_workbench::benchmark {

/// A progress bar: redrawn in place on a terminal, otherwise a line for every 5 %. Thread-safe.
class Progress {
 public:
  /// `total`: number of units, ≥ 1.
  Progress(std::ostream& out, bool terminal, std::size_t total);

  /// Starts a unit called `what`.
  void next(const std::string& what);
  /// Ends the bar.
  void finish();
  /// Time since construction [s].
  double elapsed() const;

 private:
  void draw(const std::string& what);

  std::ostream& out_;
  bool terminal_;
  std::size_t total_;
  std::size_t begun_ = 0;
  std::size_t last_mark_ = 0;
  std::chrono::steady_clock::time_point start_;
  std::mutex mutex_;
};

}  // namespace spring_workbench::benchmark
