#pragma once

#include <ostream>
#include <string>
#include <vector>

namespace spring_workbench {

/// Effect of the jitter filter on motions, as CSV. error: RMS distance of the filtered pose of a sample from the true
/// pose. lag: delay of the filtered path for the best fit to the measured path. jitter: RMS(p₋ − 2 p + p₊)/√6 of the
/// filtered path, which vanishes for three neighbouring samples on a line and is the standard deviation along all axes
/// together for white noise. Scripts (*.yaml) get noise of 0.5 mm along each axis. Throws InputError if a motion cannot
/// be read.
void write_filter_table(const std::vector<std::string>& motions, std::ostream& out);

}  // namespace spring_workbench
