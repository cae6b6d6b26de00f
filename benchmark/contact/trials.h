#pragma once

#include <ostream>
#include <string>
#include <vector>

namespace spring_workbench::benchmark {

/// The program `contact_trials`, which writes CSV to `out`:
/// - `contact_trials stress [N [FIRST_SEED [SCENE [CONTACT [DAMPING]]]]]`: N (default 100) seeded motions, by default
/// in
///   both modes, with a fork of the damping ratio DAMPING (default 1)
/// - `contact_trials record FILE SCENE CONTACT FIRST LAST [DAMPING]`: appends the results of the seeds that are not in
///   FILE yet
/// - `contact_trials drops [N [FIRST_SEED]]`: N (default 100) seeded bodies released above the bench, in both modes
/// - `contact_trials throws [N [FIRST_SEED]]`: N (default 100) seeded bodies thrown at a thin wall, fixed and loose
/// - `contact_trials scale [MOST]`: 10, 100, … MOST (default 10,000) resting objects in every contact mode
/// - `contact_trials pile|stack|cards|marbles|peg|wedge|motion|incline|bits [quick]`: a row for each case
///   (`ContactTrial`), with the measured values and their bounds
/// - `contact_trials rings|chain|map [N [FIRST]]`: the same for N (default 100) seeds or cells, with a summary
/// - `contact_trials show TRIAL MILLISECONDS`: the shapes at that time, for plot_scene.py
/// Throws InputError for other arguments.
void run_contact_trials(const std::vector<std::string>& arguments, std::ostream& out);

}  // namespace spring_workbench::benchmark
