#pragma once

#include <cstddef>

// Each with its unit, what changing it does, and the test that notices (scripts/mutate).

namespace spring_workbench::contact {

/// [m]; a contact that is not deeper counts as free, and a point that moves further along the normal of a contact has
/// rolled off it. Larger: bodies sink in. Test: StopContact.FlushAndShiftedItBendsTheForkInSShape at 1e-7, 1e-5.
constexpr double touching = 1e-6;
/// [m] of clearance that a body gets between two others that leave it no room; less if its loads move it by little.
/// Test: StopContact.FlushAndShiftedItBendsTheForkInSShape at 5e-8, 5e-6.
constexpr double slack = 0.5 * touching;
/// [m] by which the body is displaced to find what it touches. Test: AlmostFlush.LandsWithAllCornersAtOnce at 1e-6.
constexpr double probe_depth = 1e-4;
/// [m] by which a body that hits something is displaced to find the points that land together. Smaller: one that lands
/// almost flush tumbles. Test: AlmostFlush.LandsWithAllCornersAtOnce at 1e-4, 1e-2.
constexpr double landing_depth = 1e-3;
/// [s] within which they land; shorter: they tumble. Test: AlmostFlush.LandsWithAllCornersAtOnce at 1e-4.
constexpr double landing_time = 0.02;
/// Cosine of the angle between normals of contacts with one side of another body. Test: none: no value tried makes one
/// fail.
constexpr double one_side = 0.9;
/// [m/s]; an approach that is slower counts as none. Test: none: no value tried makes one fail.
constexpr double slow_approach = 1e-6;
/// Cosine of the angle between normals of contacts that count as one. Test: none: no value tried makes one fail.
constexpr double one_normal = 0.99;
/// [m]; contacts that are nearer to each other count as one. Larger: small faces lose corners. Test:
/// StopContact.APegGoesIntoAHoleWithAMillimetreToSpareWithoutRattling at 2e-2.
constexpr double same_point = 2e-3;
/// [m] between the poses that a sweep checks while bounding boxes overlap. Larger: thin things are missed; smaller:
/// slower. Test: Drops.WithoutRestitutionNothingLeavesTheBench at 1e-2.
constexpr double sweep_resolution = 2e-4;
/// [m]; penetration that a body in contact may have on its path. Test: StopContact.ShortStepsGoTheWayOfLongOnes at
/// 1e-7.
constexpr double closed = 2e-5;
/// Fraction of the displacement over a substep, and of that by the loads; loads count as found if their last change
/// moves the body by less. Larger: what slips is braked too much. Test:
/// StopContact.APegGoesIntoAHoleWithAMillimetreToSpareWithoutRattling at 0.1.
constexpr double solved_share = 0.01;
/// [m]; largest chord deviation between the path and the straight segments that are swept. Larger: corners are cut.
/// Test: none: no value tried makes one fail.
constexpr double max_chord_deviation = 5e-5;
/// Fraction of a step; what is met sooner is met now. Larger: a body bounces before it is there. Test:
/// AlmostFlush.LandsWithAllCornersAtOnce at 0.5.
constexpr double near_share = 1e-3;
/// Fraction of a step; less is none. Larger: where a fork bent far folds, the body is blocked. Test:
/// RodInRoom.IsNeverBlockedHoweverTheForkIsDampedOrFolds at 1e-3.
constexpr double min_substep_share = 1e-9;
/// Factor by which a substep is shortened if its loads could not be found. Test:
/// ContactTrials.AFallingCardHouseFallsThroughNoCard at 0.9.
constexpr double reduction = 0.25;
/// Largest number of straight segments in which the path over a substep is swept. Test: none: no value tried makes one
/// fail.
constexpr double max_segments = 4.0;
/// Factor by which the next substep is kept shorter than the longest one that is straight enough, or admissible. Test:
/// none: no value tried makes one fail.
constexpr double safety = 0.9;
/// Largest ratio of a substep to the one before, in both contact modes. Test: none: at 1000 a test does not end.
constexpr double max_growth = 2.0;
/// Largest number of substeps tried in a step; then the body is blocked for the rest of it: where an undamped fork
/// swings a million times in a step, or an open mesh pushes both ways. Test:
/// RodInRoom.IsNeverBlockedHoweverTheForkIsDampedOrFolds at 20.
constexpr int max_tries = 2000;
/// Largest number of solutions of one substep, each linearised about the last. Test: none: at 1 a test does not end.
constexpr int max_solutions = 8;
/// Largest number of solutions of one substep among movable bodies, each linearised about the loads of the last. Test:
/// none: no value tried makes one fail.
constexpr int max_dynamic_solutions = 4;
/// Fraction of the displacement or velocity without loads; a contact problem is solved to it if a few iterations do it.
/// Larger: what slips is braked too much. Test: none: no value tried makes one fail.
constexpr double load_share = 1e-5;
/// Fraction of the displacement by the loads below which a change of them counts as none. Test:
/// StopContact.ShortStepsGoTheWayOfLongOnes at 1.
constexpr double small_change = 1e-6;
/// [m]; largest error of a free body's displacement over a substep among movable ones that is longer than
/// `rough_substep`. Larger: friction and pushing are less exact. Test:
/// ContactTrials.APegOfABoxGoesInWithATenthOfAMillimetre at 1e-4.
constexpr double max_path_error = 2e-6;
/// [s]; longest substep among movable bodies where velocities change abruptly. Longer: likewise. Test:
/// ContactTrials.ACardHouseStands at 5e-3.
constexpr double rough_substep = 1e-3;
/// [s]; contact ignores a step that is shorter. Test: none: no value tried makes one fail.
constexpr double min_step = 1e-9;
/// [s]; shortest substep; in a step that is shorter than `rough_substep`, it is shorter in proportion. Smaller:
/// more tries before a body is blocked. Test: LooseThrows.AmongOthersNothingGoesDeepOrGainsEnergy at 1e-3.
constexpr double min_substep = 1e-5;
/// [s] for which a held body is blocked if no motion is possible. Test: none: with the next ones changed, too, a cell
/// of the limit cases of `dynamic` fell.
constexpr double blocked_substep = 2e-4;
/// Shortest next try, as a fraction of the substep. Test: none: see `blocked_substep`.
constexpr double min_retry = 0.1;
/// Longest next try, as a fraction of the substep. Test: none: see `blocked_substep`.
constexpr double max_retry = 0.7;
/// [m] from the path of a body within which other bodies are considered. Test: none: see `blocked_substep`.
constexpr double margin_near = 5e-4;
/// [s] over which the force of a contact is averaged: of a hit only the impulse is known. Shorter: hits are harder, and
/// their force depends on the step. Test: TaskMonitor.AHitHasTheSameForceHoweverSamplesFall at 2e-3.
constexpr double force_window = 0.02;
/// [s]; time constant with which a body that penetrates another is pushed out. Shorter: it is thrown out. Test: none:
/// no other was tried.
constexpr double recovery_time = 5e-3;

}  // namespace spring_workbench::contact
