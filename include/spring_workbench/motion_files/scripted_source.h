#pragma once

#include <string>
#include <vector>

#include "spring_workbench/motion/stylus_source.h"

namespace spring_workbench::motion_files {

/// A hand that moves from waypoint to waypoint and rests at each, by minimum-jerk motion (`10 u³ − 15 u⁴ + 6 u⁵` along
/// a straight line and about a fixed axis; Flash and Hogan, J. Neuroscience 5(7), 1985), as given by a YAML file:
///
///     rate: 50                                                   # samples per second [Hz], 0.1 … 10000
///     waypoints:
///       - {t: 0.0, pose: [0, 0, 0.3, 1, 0, 0, 0]}                # [s]; x y z qx qy qz qw [m, –]
///       - {t: 1.0, pose: [0, 0, 0.25, 1, 0, 0, 0], button: true} # the button from here on; default: false
///
/// Times must increase. There is a sample at every multiple of 1/rate after the first waypoint, and one at the last.
class ScriptedSource : public motion::StylusSource {
 public:
  /// Throws InputError with file:line, field, value and rule.
  explicit ScriptedSource(const std::string& path);
  std::optional<motion::StylusSample> next() override;

 private:
  motion::StylusSample at(double t) const;  ///< 0 ≤ t ≤ time of the last waypoint

  double rate_ = 0.0;
  std::vector<motion::StylusSample> waypoints_;  ///< never empty; the first at t = 0
  long next_ = 0;
  bool over_ = false;
};

}  // namespace spring_workbench::motion_files
