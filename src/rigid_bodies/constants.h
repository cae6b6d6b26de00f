#pragma once

#include <cstddef>

// Each with its unit, what changing it does, and the test that notices (scripts/mutate).

namespace spring_workbench::rigid_bodies {

/// [m] gap below which contacts of boxes and of planes are found (or the approach over a step, if that is more), so
/// that a fast body is stopped where it touches. Bullet's own boxes have contacts only when they overlap. Test:
/// RigidWorld.DrivenBodyPushesANeighbourAndCarriesAnother at 0.
constexpr double contact_margin = 3e-3;
/// [m] by which every shape is enlarged; a contact is closed when two shapes overlap by twice as much, so that the
/// solver knows it before. Larger: spheres roll on a larger radius. Test:
/// RigidWorld.SphereRollsAtFiveSeventhsOfItsSpeed.
constexpr double contact_skin = 1e-4;
/// [m] distance from an awake body within which bodies enter Bullet's world. Contact mode `dynamic` itself uses 0.5 mm:
/// no reason known. Test: RigidWorld.SleepersCostNothingAndStay at 0.2.
constexpr double margin_near = 2e-3;
/// Number of steps without an awake body near after which a sleeping body leaves Bullet's world. Fewer: it enters and
/// leaves repeatedly; more: it costs longer. Test: RigidWorld.SleepersCostNothingAndStay at 5000.
constexpr int steps_until_left = 50;
/// [s] for which a body is slow before it sleeps. With contact mode `stop` 0.2 s: no reason known. Test:
/// RigidWorld.StackOfTenStandsAndSleeps at 5.
constexpr double asleep_after = 0.5;
/// Fraction of a penetration between free bodies that is corrected in a step. Larger: piles tremble. Test:
/// RigidWorld.StackOfTenStandsAndSleeps at 2.
constexpr double penetration_share = 0.2;
/// The same between a free and a driven body, in `recovery_time`. Smaller: what is driven by a rising force goes
/// deeper. Test: ContactTrials.APegOfABoxGoesInWithATenthOfAMillimetre at 0.2.
constexpr double driven_penetration_share = 0.4;
/// [m] that a body may move towards shapes other than boxes without a sweep; on a path on which contact is allowed,
/// between two looks at how deep they are. Larger: deeper penetration; smaller: blocked more often, and slower. Test:
/// none: no value tried makes one fail.
constexpr double unswept = 2e-4;
/// [m] likewise for a path on which contact is allowed, and depth beyond which contacts of solids are only continued.
/// Larger: thrown bodies pass through thin ones; smaller: bodies that fly and roll among movable ones cost more. Test:
/// LooseThrows.AmongOthersNothingGoesDeepOrGainsEnergy at 0.02.
constexpr double unswept_of_free = 1e-3;
/// [m] largest penetration of two boxes on a path; shorter paths of bodies that are not held are not swept. Smaller:
/// held bodies are blocked more often. Test: RigidWorld.AWayEndsWhereItTouches.
constexpr double deepest_on_path = 5e-5;
/// [m] penetration by which one must be deeper to count so; of rounding. Larger: deeper penetration. Test:
/// RigidWorld.AWayEndsWhereItTouches at 1e-3.
constexpr double same_depth = 1e-10;
/// [m] depth of the deepest contact of a solved step, at its start. Larger: deeper ones are not reported. Test:
/// RigidWorld.WhatOverlapsAtTheStartComesOutAndCounts at 1.
constexpr double deepest_solved = 1e-4;
/// Cosine of the angle between normals of contacts of two shapes of which four are kept. Smaller: curved shapes lose
/// contacts. Test: RigidWorld.ABoxStopsInANotchWithBothItsFaces at -1.
constexpr double one_normal = 0.99;
/// Manifolds of four contacts for a pair of shapes other than boxes. Fewer: it is not stopped in all directions, which
/// counts. Test: RigidWorld.ABoxStopsInANotchWithBothItsFaces at 1.
constexpr std::size_t max_manifolds = 8;
/// [m] gap below which a contact without impulse is reported. Test: none: no value tried makes one fail.
constexpr double closed_gap = 1e-5;
/// [m] largest residual of the contacts of a solved step. Larger: friction is as much less exact. Test:
/// RigidWorld.StackOfTenStandsAndSleeps at 1e-3.
constexpr double solved_to = 1e-6;
/// [m] residual to which they are solved where nothing moves. Larger: stacks of unlike masses sink and drift. Test:
/// none: 1e-6 in a minute of `contact_trials stack` alone.
constexpr double rest_residual = 4e-8;
/// The same as a fraction of the largest motion, up to `solved_to`. Larger: less exact. Test:
/// ContactTrials.APegOfABoxGoesInWithATenthOfAMillimetre at 0.1.
constexpr double residual_share = 3e-3;
/// The same as a fraction of the largest motion without loads, if it takes few iterations to get there. Test:
/// RigidWorld.StackOfTenStandsAndSleeps at 0.1.
constexpr double solved_share = 1e-4;
/// [m] gap below which a contact is stopped by an impulse. Test: none: no value tried makes one fail.
constexpr double closed = 5e-5;
/// [s]; free bodies that would touch sooner bounce off each other now. Longer: before they touch. Test:
/// RigidWorld.BallBouncesToTheSquareOfItsRestitution at 1e-3.
constexpr double at_once = 1e-5;
/// [s] in which a penetration by a driven body is corrected. Shorter: the correction becomes a velocity. Contact mode
/// `stop` uses 5 ms: no reason known. Test: none: no value tried makes one fail.
constexpr double recovery_time = 2e-3;

}  // namespace spring_workbench::rigid_bodies
