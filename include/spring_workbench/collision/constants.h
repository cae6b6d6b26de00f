#pragma once

// Each with its unit, what changing it does, and the test that notices (scripts/mutate); the constants of the contact
// points are in src/collision/constants.h.

namespace spring_workbench::collision {

/// [m]; a body whose gap above an object is smaller rests on that object, and wakes when the object is grasped or
/// falls; a body whose gap above all others is larger falls at the start. Larger: it hangs in the air. Test:
/// Falling.WhatNothingCarriesFallsAndWhatStandsStays at 0.1.
constexpr double support_gap = 1e-4;
/// A contact carries a body if the z component of its unit normal exceeds this. Larger: a body on a slope falls at the
/// start, or hangs in the air when the slope is taken away. Test: Falling.WhatNothingCarriesFallsAndWhatStandsStays
/// at 1.
constexpr double min_support = 0.1;

}  // namespace spring_workbench::collision
