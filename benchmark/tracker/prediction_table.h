#pragma once

#include <ostream>
#include <string>
#include <vector>

namespace spring_workbench {

/// How far what is displayed is from what is later committed for the same time, as CSV. The box of a scene
/// (single_box.urdf) is held on each motion by the default fork; at the arrival of each sample the simulation is
/// committed as far as its input is complete, and copies of it go ahead to that sample (0 ms) and beyond it. Compared
/// is the held box. Contact none: in the air; stop: above a bench at such a height that the hand is as often below it
/// as above. The tracked body is turned so that the fork points down at first. `seconds` [s]: the part of each motion.
/// Throws InputError where a motion cannot be read.
void write_prediction_table(const std::string& scene_path, const std::vector<std::string>& motions, double seconds,
                            std::ostream& out);

}  // namespace spring_workbench
