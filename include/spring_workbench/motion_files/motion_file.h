#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "spring_workbench/motion/stylus_source.h"

namespace spring_workbench::motion_files {

/// Reads lines of `t x y z qx qy qz qw [button]` (s, m, unit quaternion, 0 or 1), the format of the TUM benchmarks; `#`
/// starts a comment, empty lines are skipped, a byte order mark is ignored, and either all lines or none have a button.
/// Times are rounded to ns. Quaternions with a norm in [0.5, 2] are normalised, and their norm is kept. Throws
/// InputError with file:line, field, value and rule for anything else.
std::vector<motion::StylusSample> read_motion_file(const std::string& path);

/// Returns the given samples one by one.
class RecordedSource : public motion::StylusSource {
 public:
  explicit RecordedSource(std::vector<motion::StylusSample> samples);
  std::optional<motion::StylusSample> next() override;

 private:
  std::vector<motion::StylusSample> samples_;
  std::size_t next_ = 0;
};

}  // namespace spring_workbench::motion_files
