#pragma once

#include <chrono>
#include <cstddef>
#include <mutex>
#include <ostream>
#include <string>

namespace spring_workbench::benchmark {

/// A progress bar: redrawn in place on a terminal, elsewhere a line at every twentieth of the way. Safe to use from
/// several threads.
class Progress {
 public:
  /// `total` ≥ 1 units to come.
  Progress(std::ostream& out, bool terminal, std::size_t total);

  /// A unit begins; `what` is it.
  void next(const std::string& what);
  /// All is done.
  void finish();
  /// Since this was made [s].
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
