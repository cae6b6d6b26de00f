#pragma once

// Each with its unit, what changing it does, and the test that notices (scripts/mutate); the constants of the contact
// points are in src/collision/constants.h.

namespace spring_workbench::collision {

/// [m]; a body with a smaller gap above an object rests on it, and wakes when that object is grasped or falls; a body
/// with a larger gap above all others falls at the start. Larger: it hangs in the air. Test:
/// Falling.WhatNothingCarriesFallsAndWhatStandsStays at 0.1.
constexpr double support_gap = 1e-4;
/// Of a contact's normal along z, from where on it carries. Larger: what lies on a slope falls, or floats when that is
/// taken. Test: Falling.WhatNothingCarriesFallsAndWhatStandsStays at 1.
constexpr double least_support = 0.1;

}  // namespace spring_workbench::collision
