#pragma once

#include <iomanip>
#include <sstream>
#include <string>

namespace spring_workbench::registration {

/// Formats a length [m] for a message, e.g. "5.31 mm".
inline std::string millimetres(double metres) {
  std::ostringstream out;
  out << std::setprecision(3) << 1e3 * metres << " mm";
  return out.str();
}

}  // namespace spring_workbench::registration
