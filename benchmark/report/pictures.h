#pragma once

#include <string>
#include <vector>

namespace spring_workbench::benchmark {

/// A picture of the report: `plot_report.py KIND TABLE PICTURE OTHERS…`.
struct Picture {
  std::string kind;
  std::string table;                ///< path of a CSV file
  std::string name;                 ///< of the PNG file
  std::vector<std::string> others;  ///< further arguments of this kind
  std::string caption;
};

/// Draws the picture into `folder` with a Python script of the package. Returns the path of the PNG file; empty, with a
/// message on stderr, if that fails (e.g. without Python 3 or matplotlib, package python3-matplotlib).
std::string draw(const Picture& picture, const std::string& folder);

}  // namespace spring_workbench::benchmark
