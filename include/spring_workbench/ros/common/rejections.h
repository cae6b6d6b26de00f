#pragma once

#include <cstddef>
#include <map>
#include <string>

namespace spring_workbench::ros_common {

/// Counts rejected input by reason and logs it, at most one line per reason in five seconds.
class Rejections {
 public:
  /// `line`: what is wrong with the input, and what would be valid.
  void add(const std::string& reason, const std::string& line);
  /// Adds a message for which the queue to the physics loop has no room. `place`: e.g. "stylus/joy: ".
  void add_loop_stalled(const std::string& place);
  /// Counts without logging: another line says why.
  void count(const std::string& reason) { ++counts_[reason]; }
  const std::map<std::string, std::size_t>& counts() const { return counts_; }

 private:
  std::map<std::string, std::size_t> counts_;
  std::map<std::string, double> last_logged_;  ///< when a reason was last logged [s]
};

}  // namespace spring_workbench::ros_common
