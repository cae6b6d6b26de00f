#pragma once

#include <string>
#include <vector>

namespace spring_workbench::benchmark {

/// A picture of the report: `plot_report.py KIND TABLE PICTURE OTHERS…`.
struct Picture {
  std::string kind;
  std::string table;                ///< path of a CSV file
  std::string name;                 ///< of the PNG file
  std::vector<std::string> others;  ///< what the kind wants besides
  std::string caption;
};

/// Draws into `folder` by the Python script that stands beside the package. Path of the PNG file; empty where it did
/// not come about, which is said on stderr: without Python 3 and matplotlib (package python3-matplotlib).
std::string draw(const Picture& picture, const std::string& folder);

}  // namespace spring_workbench::benchmark
