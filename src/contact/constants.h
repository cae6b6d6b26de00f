#pragma once

// The constants of the module: unit, what changing one does, and the test that notices.

namespace spring_workbench::contact {

/// [m]; what is not deeper is free, and a point that goes further along a contact's normal has rolled off it. Larger:
/// bodies sink in. `Simulation.PressedOnTheBenchItStaysOutsideAndTheForkTakesUpTheDifference`
constexpr double touching = 1e-6;
/// [m] left to a body between two others that leave it no room.
/// `StopContact.BetweenTwoSurfacesItSlidesAndStaysOutOfBoth`
constexpr double slack = 0.5 * touching;
/// [m] by which the body is pushed to see what it touches. `StopContact.BetweenTwoSurfacesItSlidesAndStaysOutOfBoth`
constexpr double probe_depth = 1e-4;
/// [m]; contacts nearer to each other are one. Larger: small faces lose corners.
/// `StopContact.APegGoesIntoAHoleWithAMillimetreToSpareWithoutRattling`
constexpr double same_point = 2e-3;
/// [m] between the poses that a sweep looks at, where boxes overlap. Larger: thin things are missed; smaller: slower.
/// `StopContact.APegGoesIntoAHoleWithAMillimetreToSpareWithoutRattling`
constexpr double sweep_resolution = 2e-4;
/// [m]; on its way a body in contact may be so deep.
/// `Simulation.PressedOnTheBenchItStaysOutsideAndTheForkTakesUpTheDifference`
constexpr double closed = 2e-5;
/// [s] on which a body that is in another comes out. Shorter: it is thrown out. With contact mode `dynamic` 2 ms: no
/// reason known. `StopExtremes.GraspedWhileItTouchesOrOverlapsItComesAlong`
constexpr double recovery_time = 5e-3;
/// of the way over a piece; loads that move the body by less are found.
/// `StopExtremes.LightAndHeavyStiffAndSoftPressedAndShiftedStayBounded`
constexpr double solved_share = 0.01;
/// [m] between the way and each of the straight ones that are swept. Larger: corners are cut.
/// `StopContact.APegGoesIntoAHoleWithAMillimetreToSpareWithoutRattling`
constexpr double most_chord_deviation = 5e-5;
/// [m]; loads under which the body goes such a way will not be mended.
/// `StopExtremes.LightAndHeavyStiffAndSoftPressedAndShiftedStayBounded`
constexpr double hopeless_chord_deviation = 0.1;
/// [m/s]; a slower one is none. `StopExtremes.LightAndHeavyStiffAndSoftPressedAndShiftedStayBounded`
constexpr double slow_approach = 1e-6;
/// of a step; a shorter piece is not tried. `StopExtremes.LightAndHeavyStiffAndSoftPressedAndShiftedStayBounded`
constexpr double shortest_share = 1e-3;
/// of a step, for which a body stays where nothing fits.
/// `StopExtremes.LightAndHeavyStiffAndSoftPressedAndShiftedStayBounded`
constexpr double blocked_share = 0.1;
/// of a piece in contact that could not be solved: the next try.
/// `StopExtremes.LightAndHeavyStiffAndSoftPressedAndShiftedStayBounded`
constexpr double shorter = 0.25;
/// straight ones for which the way over a piece is swept.
/// `StopContact.APegGoesIntoAHoleWithAMillimetreToSpareWithoutRattling`
constexpr double most_segments = 4.0;
/// of the longest piece that is straight enough. `StopContact.APegGoesIntoAHoleWithAMillimetreToSpareWithoutRattling`
constexpr double safety = 0.9;
/// times the last piece is, at most, the next one; in both contact modes.
/// `StopContact.APegGoesIntoAHoleWithAMillimetreToSpareWithoutRattling`
constexpr double longer = 2.0;
/// pieces tried in a step. `StopExtremes.LightAndHeavyStiffAndSoftPressedAndShiftedStayBounded`
constexpr int most_tries = 100;
/// pieces of a step without a solution, before the body stays.
/// `StopExtremes.LightAndHeavyStiffAndSoftPressedAndShiftedStayBounded`
constexpr int most_unsolved = 6;
/// solutions of one piece of a step, each about the last. With contact mode `dynamic` 4: no reason known.
/// `StopExtremes.LightAndHeavyStiffAndSoftPressedAndShiftedStayBounded`
constexpr int most_solutions = 8;
/// of one piece among movable bodies, each about the loads of the last.
/// `DynamicContact.LightAndHeavyStiffAndSoftAgainstAWallStayBounded`
constexpr int most_dynamic_solutions = 4;
/// of solve_contacts(). `StopExtremes.LightAndHeavyStiffAndSoftPressedAndShiftedStayBounded`
constexpr int most_sweeps = 200;
/// of the largest load; the sweeps end where none changes by more.
/// `Simulation.PressedOnTheBenchItStaysOutsideAndTheForkTakesUpTheDifference`
constexpr double small_change = 1e-10;
/// [s] among movable bodies, where something is touched. Longer: friction and pushing are less exact.
/// `DynamicContact.PushesANeighbourAlong`
constexpr double longest_piece = 2e-3;
/// [s] where a body moves that nobody holds: the world's error is of order one.
/// `DynamicContact.PushesANeighbourAlong`
constexpr double longest_with_free = 1e-3;
/// [s]; of a step shorter than this contact takes no notice.
/// `DynamicContact.LightAndHeavyStiffAndSoftAgainstAWallStayBounded`
constexpr double shortest_step = 1e-9;
/// [s] for which a held body stays where nothing else fits.
/// `DynamicContact.LightAndHeavyStiffAndSoftAgainstAWallStayBounded`
constexpr double blocked_substep = 2e-4;
/// of the part of a piece that is sound: the next try.
/// `DynamicContact.LightAndHeavyStiffAndSoftAgainstAWallStayBounded`
constexpr double as_sound = 0.9;
/// of a piece: the next try, at least. `DynamicContact.LightAndHeavyStiffAndSoftAgainstAWallStayBounded`
constexpr double least_try = 0.1;
/// of a piece: the next try, at most. `DynamicContact.LightAndHeavyStiffAndSoftAgainstAWallStayBounded`
constexpr double most_try = 0.7;
/// [s], or of a step that is shorter than the longest piece, as much less. Smaller: more tries before a body stays.
/// `DynamicContact.LightAndHeavyStiffAndSoftAgainstAWallStayBounded`
constexpr double shortest_piece = 1e-5;
/// [m] from a body's way, from which on what is there is looked at.
/// `DynamicContact.ANeighbourThatIsNotTouchedIsNotFelt`
constexpr double margin_near = 5e-4;

}  // namespace spring_workbench::contact
