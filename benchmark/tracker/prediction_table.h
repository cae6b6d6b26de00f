#pragma once

#include <ostream>
#include <string>
#include <vector>

namespace spring_workbench {

/// Error of the displayed pose against the pose committed later for the same time, as CSV. The default fork holds the
/// box of a scene (single_box.urdf) on each motion. When a sample arrives, the simulation is committed as far as its
/// input is complete, and copies of it are advanced to that sample (0 ms) and beyond. The pose of the held box is
/// compared. Contact none: in the air; stop and dynamic: above a bench at the median height of the hand. The tracked
/// body is turned such that the fork points down at first. Samples that the input filter rejects are not shown. Throws
/// InputError if a motion cannot be read.
void write_prediction_table(const std::string& scene_path, const std::vector<std::string>& motions, std::ostream& out);

}  // namespace spring_workbench
