#pragma once

#include <ostream>
#include <string>
#include <vector>

namespace spring_workbench::benchmark {

/// The program `contact_trials`; a CSV on `out`.
/// - `contact_trials wild [N [FIRST_SEED [SCENE [CONTACT [DAMPING]]]]]`: N (default 100) seeded motions, in both modes
/// by
///   default, with a fork of the damping ratio DAMPING (default 1)
/// - `contact_trials record FILE SCENE CONTACT FIRST LAST [DAMPING]`: each seed's result is added to FILE; those there
///   stay
/// - `contact_trials drops [N [FIRST_SEED]]`: N (default 100) seeded things let go above the bench, in both modes
/// - `contact_trials throws [N [FIRST_SEED]]`: N (default 100) seeded things thrown at a thin wall, fixed and loose
/// - `contact_trials scale [MOST]`: 10, 100, … MOST (default 10,000) resting objects in every contact mode
/// - `contact_trials pile|stack|cards|marbles|peg|wedge|motion|incline|bits [quick]`: a row for each case
///   (`ContactTrial`), with its figures beside their bars
/// - `contact_trials rings|chain|map [N [FIRST]]`: likewise, for N (default 100) seeds or cells, and all together
/// - `contact_trials show TRIAL MILLISECONDS`: its shapes at that time, for plot_scene.py
/// Throws InputError for other arguments.
void run_contact_trials(const std::vector<std::string>& arguments, std::ostream& out);

}  // namespace spring_workbench::benchmark
