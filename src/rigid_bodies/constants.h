#pragma once

#include <cstddef>

// Each with its unit, what changing it does, and the test that notices (scripts/mutate).

namespace spring_workbench::rigid_bodies {

/// [m], or as far as they come in a step, from which boxes and planes see what they know the shape of, so that what
/// comes near fast is stopped where it touches. Bullet's own boxes see each other where they overlap. Test:
/// RigidWorld.DrivenBodyPushesANeighbourAndCarriesAnother at 0.
constexpr double seen_from = 3e-3;
/// Of a face, against a plane, that touches it with all its sides. Smaller: what lands tilted by more lands with one
/// point; larger: those of the sides above are taken for it. Test: Drops.WithoutRestitutionNothingLeavesTheBench at 0.
constexpr double slope_of_landing = 0.1;
/// [m] by which every shape is larger all round; contact is closed where two overlap by twice as much: so that the
/// solver sees it before. Larger: spheres roll on a larger radius. Test:
/// RigidWorld.SphereRollsAtFiveSeventhsOfItsSpeed.
constexpr double contact_skin = 1e-4;
/// [m]; what comes nearer than this to an awake body enters Bullet's world. Contact mode `dynamic` itself looks for
/// what is touched from 0.5 mm: no reason known. Test: RigidWorld.SleepersCostNothingAndStay at 0.2.
constexpr double margin_near = 2e-3;
/// Without anything awake near, after which a sleeper leaves Bullet's world. Fewer: it goes and comes; more: it costs
/// longer. Test: RigidWorld.SleepersCostNothingAndStay at 5000.
constexpr int steps_until_left = 50;
/// [s] for which a body is slow before it sleeps. With contact mode `stop` 0.2 s: no reason known. Test:
/// RigidWorld.StackOfTenStandsAndSleeps at 5.
constexpr double asleep_after = 0.5;
/// Of a penetration that is undone in a step, where that pushes free bodies. Larger: piles tremble. Test:
/// RigidWorld.StackOfTenStandsAndSleeps at 2.
constexpr double penetration_share = 0.2;
/// [m] that a body may go towards what is near, where the shapes are not boxes. Larger: deeper; smaller: held back.
/// Test: none: no value tried makes one fail.
constexpr double blind_way = 2e-4;
/// [m], likewise of a body that nobody holds, on a way that is not shorter. Larger: thrown things go through thin ones;
/// smaller: what flies and rolls among movable bodies costs more. Test: LooseThrows.ALooseThinWallIsNotGoneThrough at
/// 0.02.
constexpr double blind_way_of_free = 1e-3;
/// [m]; no deeper goes a box into another, and what nobody holds is not looked at on a shorter way. Smaller: held
/// bodies are held back more often. Test: RigidWorld.AWayEndsWhereItTouches.
constexpr double deepest_way = 5e-5;
/// [m]; a contact without impulse is told while its gap is smaller. Test: none: no value tried makes one fail.
constexpr double closed_gap = 1e-5;
/// [m]; a step in which no contact misses its law by more is solved. Test: none: no value tried makes one fail.
constexpr double small_miss = 1e-6;
/// Of the largest motion without loads, to which contacts are solved if that takes few iterations. Test:
/// RigidWorld.StackOfTenStandsAndSleeps at 0.1.
constexpr double small_share = 1e-4;
/// [m]; a contact with a smaller gap is stopped by an impulse. Test: none: no value tried makes one fail.
constexpr double closed = 5e-5;
/// [s] in which a penetration by a driven body is undone. Shorter: it becomes a speed. With contact mode `stop` 5 ms:
/// no reason known. Test: none: no value tried makes one fail.
constexpr double recovery_time = 2e-3;
/// [m/s]; a slower approach of a driven body is none. Test: none: no value tried makes one fail.
constexpr double slow = 1e-7;

}  // namespace spring_workbench::rigid_bodies
