#pragma once

#include <ostream>
#include <string>
#include <vector>

namespace spring_workbench {

/// What the jitter filter does to motions, as CSV.
/// error: RMS distance of the pose given for a sample from where the hand was. lag: by how much the
/// path given comes later than the path measured, where the two fit best. jitter: the
/// part of the path given that three neighbouring samples on a line would not have, RMS(p₋ − 2 p + p₊)/√6, which for
/// white noise is its standard deviation along all axes together. A script (*.yaml) is given noise of 0.5 mm along each
/// axis. Throws InputError where a motion cannot be read.
void write_filter_table(const std::vector<std::string>& motions, std::ostream& out);

}  // namespace spring_workbench
