#pragma once

#include <string>
#include <vector>

#include "spring_workbench/motion_files/open_motion.h"

namespace spring_workbench {

/// All samples of a motion file or script. Throws InputError if it cannot be read.
inline std::vector<motion::StylusSample> read_samples(const std::string& path) {
  std::vector<motion::StylusSample> samples;
  const auto source = motion_files::open_motion(path);
  while (const auto sample = source->next()) samples.push_back(*sample);
  return samples;
}

/// The name of the file without folders.
inline std::string file_name(const std::string& path) { return path.substr(path.rfind('/') + 1); }

}  // namespace spring_workbench
