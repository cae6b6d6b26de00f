#pragma once

// The constants of the module: unit, what changing one does, and the test that notices: "noticed by" was seen to fail
// with another value, "goes into" is by reading alone.

namespace spring_workbench::contact {

/// [m]; what is not deeper is free, and a point that goes further along a contact's normal has rolled off it. Larger:
/// bodies sink in. Goes into `Simulation.PressedOnTheBenchItStaysOutsideAndTheForkTakesUpTheDifference`.
constexpr double touching = 1e-6;
/// [m] left to a body between two others that leave it no room. Goes into
/// `StopContact.BetweenTwoSurfacesItSlidesAndStaysOutOfBoth`.
constexpr double slack = 0.5 * touching;
/// [m] by which the body is pushed to see what it touches. Goes into
/// `StopContact.BetweenTwoSurfacesItSlidesAndStaysOutOfBoth`.
constexpr double probe_depth = 1e-4;
/// [m] by which a body that hits something is pushed to see what lands with it. Smaller: what lands almost flush lands
/// with one corner after the other, and tumbles. Goes into `Drops.WithoutRestitutionNothingLeavesTheBench`.
constexpr double landing_depth = 1e-3;
/// [m]; contacts nearer to each other are one. Larger: small faces lose corners. Goes into
/// `StopContact.APegGoesIntoAHoleWithAMillimetreToSpareWithoutRattling`.
constexpr double same_point = 2e-3;
/// [m] between the poses that a sweep looks at, where boxes overlap. Larger: thin things are missed; smaller: slower.
/// Goes into `StopContact.APegGoesIntoAHoleWithAMillimetreToSpareWithoutRattling`.
constexpr double sweep_resolution = 2e-4;
/// [m]; on its way a body in contact may be so deep. Goes into
/// `Simulation.PressedOnTheBenchItStaysOutsideAndTheForkTakesUpTheDifference`.
constexpr double closed = 2e-5;
/// [s] on which a body that is in another comes out. Shorter: it is thrown out. With contact mode `dynamic` 2 ms: no
/// reason known. Goes into `StopExtremes.GraspedWhileItTouchesOrOverlapsItComesAlong`.
constexpr double recovery_time = 5e-3;
/// Of the way over a piece; loads that move the body by less are found. Goes into
/// `StopExtremes.LightAndHeavyStiffAndSoftPressedAndShiftedStayBounded`.
constexpr double solved_share = 0.01;
/// [m] between the way and each of the straight ones that are swept. Larger: corners are cut. Goes into
/// `StopContact.APegGoesIntoAHoleWithAMillimetreToSpareWithoutRattling`.
constexpr double most_chord_deviation = 5e-5;
/// [m]; loads under which the body goes such a way will not be mended. Goes into
/// `StopExtremes.LightAndHeavyStiffAndSoftPressedAndShiftedStayBounded`.
constexpr double hopeless_chord_deviation = 0.1;
/// [m/s]; a slower one is none. Goes into `StopExtremes.LightAndHeavyStiffAndSoftPressedAndShiftedStayBounded`.
constexpr double slow_approach = 1e-6;
/// Of a step; a shorter piece is not tried. Goes into
/// `StopExtremes.LightAndHeavyStiffAndSoftPressedAndShiftedStayBounded`.
constexpr double shortest_share = 1e-3;
/// Of a step, for which a body stays where nothing fits. Goes into
/// `StopExtremes.LightAndHeavyStiffAndSoftPressedAndShiftedStayBounded`.
constexpr double blocked_share = 0.1;
/// Of a piece in contact that could not be solved: the next try. Goes into
/// `StopExtremes.LightAndHeavyStiffAndSoftPressedAndShiftedStayBounded`.
constexpr double shorter = 0.25;
/// Straight ones for which the way over a piece is swept. Goes into
/// `StopContact.APegGoesIntoAHoleWithAMillimetreToSpareWithoutRattling`.
constexpr double most_segments = 4.0;
/// Of the longest piece that is straight enough. Goes into
/// `StopContact.APegGoesIntoAHoleWithAMillimetreToSpareWithoutRattling`.
constexpr double safety = 0.9;
/// Times the last piece is, at most, the next one; in both contact modes. Goes into
/// `StopContact.APegGoesIntoAHoleWithAMillimetreToSpareWithoutRattling`.
constexpr double longer = 2.0;
/// Pieces tried in a step. Goes into `StopExtremes.LightAndHeavyStiffAndSoftPressedAndShiftedStayBounded`.
constexpr int most_tries = 100;
/// Pieces of a step without a solution, before the body stays. Goes into
/// `StopExtremes.LightAndHeavyStiffAndSoftPressedAndShiftedStayBounded`.
constexpr int most_unsolved = 6;
/// Solutions of one piece of a step, each about the last. With contact mode `dynamic` 4: no reason known. Goes into
/// `StopExtremes.LightAndHeavyStiffAndSoftPressedAndShiftedStayBounded`.
constexpr int most_solutions = 8;
/// Of one piece among movable bodies, each about the loads of the last. Goes into
/// `DynamicContact.LightAndHeavyStiffAndSoftAgainstAWallStayBounded`.
constexpr int most_dynamic_solutions = 4;
/// Of solve_contacts(). Goes into `StopExtremes.LightAndHeavyStiffAndSoftPressedAndShiftedStayBounded`.
constexpr int most_sweeps = 200;
/// Of the largest load; the sweeps end where none changes by more. Goes into
/// `Simulation.PressedOnTheBenchItStaysOutsideAndTheForkTakesUpTheDifference`.
constexpr double small_change = 1e-10;
/// [s] among movable bodies, where something is touched. Longer: friction and pushing are less exact. Goes into
/// `DynamicContact.PushesANeighbourAlong`.
constexpr double longest_piece = 2e-3;
/// [s] where a body moves that nobody holds: the world's error is of order one. Goes into
/// `DynamicContact.PushesANeighbourAlong`.
constexpr double longest_with_free = 1e-3;
/// [s]; of a step shorter than this contact takes no notice. Goes into
/// `DynamicContact.LightAndHeavyStiffAndSoftAgainstAWallStayBounded`.
constexpr double shortest_step = 1e-9;
/// [s] for which a held body stays where nothing else fits. Goes into
/// `DynamicContact.LightAndHeavyStiffAndSoftAgainstAWallStayBounded`.
constexpr double blocked_substep = 2e-4;
/// Of the part of a piece that is sound: the next try. Goes into
/// `DynamicContact.LightAndHeavyStiffAndSoftAgainstAWallStayBounded`.
constexpr double as_sound = 0.9;
/// Of a piece: the next try, at least. Goes into `DynamicContact.LightAndHeavyStiffAndSoftAgainstAWallStayBounded`.
constexpr double least_try = 0.1;
/// Of a piece: the next try, at most. Goes into `DynamicContact.LightAndHeavyStiffAndSoftAgainstAWallStayBounded`.
constexpr double most_try = 0.7;
/// [s], or of a step that is shorter than the longest piece, as much less. Smaller: more tries before a body stays.
/// Goes into `DynamicContact.LightAndHeavyStiffAndSoftAgainstAWallStayBounded`.
constexpr double shortest_piece = 1e-5;
/// [m] from a body's way, from which on what is there is looked at. Goes into
/// `DynamicContact.ANeighbourThatIsNotTouchedIsNotFelt`.
constexpr double margin_near = 5e-4;

}  // namespace spring_workbench::contact
