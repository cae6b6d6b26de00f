#pragma once

#include <iomanip>
#include <sstream>
#include <string>

namespace spring_workbench::registration {

/// `metres` in a message: "5.31 mm".
inline std::string millimetres(double metres) {
  std::ostringstream out;
  out << std::setprecision(3) << 1e3 * metres << " mm";
  return out.str();
}

}  // namespace spring_workbench::registration
