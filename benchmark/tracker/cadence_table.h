#pragma once

#include <ostream>
#include <string>
#include <vector>

namespace spring_workbench {

/// How far stamps are off before and after the cadence clock, as CSV: one line for each motion as it was recorded, each
/// motion behind a delayed line, and the FASTRAK simulator on a pseudo-terminal in real time (half a minute each).
/// Jitter is a standard deviation. Behind a line and on the pseudo-terminal it is that of the stamp less the moment of
/// measuring, which there is known; of a motion as it was recorded it is that of the time between neighbours, over √2,
/// where none is missing between them.
/// The first ten seconds, in which the cadence is learnt, are left out. Throws InputError where a motion cannot be
/// read.
void write_cadence_table(const std::vector<std::string>& motions, std::ostream& out);

}  // namespace spring_workbench
