#pragma once

#include <ostream>
#include <string>
#include <vector>

namespace spring_workbench {

/// Errors of stamps before and after the cadence clock, as CSV: one row for each motion as recorded, each motion with
/// simulated delays, and the FASTRAK simulator on a pseudo-terminal in real time (half a minute each). Jitter is a
/// standard deviation: for simulated delays and on the pseudo-terminal, of the stamp minus the known time of
/// measurement; for a motion as recorded, of the time between neighbours without a gap, divided by √2. The first ten
/// seconds, in which the rate is estimated, are excluded. Throws InputError if a motion cannot be read.
void write_cadence_table(const std::vector<std::string>& motions, std::ostream& out);

}  // namespace spring_workbench
