#pragma once

// The constants of the module: unit, what changing one does, and the test that notices: "noticed by" was seen to fail
// with another value, "goes into" is by reading alone.

namespace spring_workbench::tools {

/// Of what would hold the object's mass within a step: so that no direction of a shared tool is without any. Larger:
/// tools without springs pull. Goes into `Probe.NoStiffnessMakesAPushBlowUp`.
constexpr double least_stiffness = 1e-9;
/// [m] of the tool `spring`, which has a direction then. Goes into `Tools.SpringExtendsByTheWeightAndExertsNoMoment`.
constexpr double least_rest_length = 1e-4;
/// [m]; a shorter span of the tool `spring` has no direction. Goes into
/// `Tools.SpringExtendsByTheWeightAndExertsNoMoment`.
constexpr double no_length = 1e-12;
/// Of the fork's length: radius of gyration of a point mass. Larger: it is no point. Goes into
/// `Simulation.PointMassOnTheAxisDoesNotTwistAndOffItDoes`.
constexpr double point_mass_radius = 1e-2;
/// Of the fork's length; a point mass so near to the fork's axis cannot twist it. Goes into
/// `Simulation.PointMassOnTheAxisDoesNotTwistAndOffItDoes`.
constexpr double on_the_axis = 1e-3;
/// [s] on which the proxy comes back to the hand. Shorter: the object catches up faster. Goes into
/// `StopContact.AForkThatCannotFollowPressesAsItsRuleSaysAndHoldsNothingBack`.
constexpr double return_time = 0.05;
/// [s]; squared over the object's mass, how the proxy gives way at rest. Longer: what cannot follow presses less.
/// Goes into `StopContact.AForkThatCannotFollowPressesAsItsRuleSaysAndHoldsNothingBack`.
constexpr double give_time = 5e-3;
/// [m, rad]; the proxy has come back. Goes into `Simulation.RigidForkLeavesTheHandleBehindInsteadOfPushingThrough`.
constexpr double no_offset = 1e-9;
/// [m/s], and of a turning times the fork's length, below which an object on a hand at rest stops (the paper's
/// threshold, section 3.3). Goes into `HeldAtRest.CostsNothing`.
constexpr double still_speed = 1e-7;
/// [m/s²], likewise. Goes into `HeldAtRest.SagsByItsWeight`.
constexpr double still_acceleration = 1e-6;
/// [m] from the origin; a hand further away is not one to go on with. Goes into
/// `Simulation.SettingsThatDoNotFitAreRefused`.
constexpr double largest_distance = 1e6;
/// Of the generalised force that the springs of a fork gripped anew are to do. Goes into
/// `TwoHands.HandoverMovesTheObjectLessThanAMillimetre`.
constexpr double exact_pull = 1e-12;
/// Of a free body's compliance: how what has no coordinate gives way where tools share an object. Larger: rigid tools
/// are soft. Goes into `TwoHands.HandoverBetweenRigidToolsMovesNothing`.
constexpr double rigid_share = 1e-3;
/// Of fitting the strain to where a shared object is. Goes into `TwoHands.ObjectOfTwoKilogramsOnTwoForksSagsHalf`.
constexpr int most_fit_iterations = 20;
/// [m, rad], to which it is fitted. Goes into `TwoHands.ObjectOfTwoKilogramsOnTwoForksSagsHalf`.
constexpr double fitted = 1e-13;
/// Of the probe's depth; a material that gives way less is rigid. Goes into
/// `Probe.ReadsRigidAsInfiniteAndTheAirAsNothing`.
constexpr double no_give = 1e-9;
/// [m], one standard deviation: how well a tracker knows where the probe's tip is. The uncertainty that it tells is
/// in proportion. Goes into `Probe.ReadsTheMaterialStiffnessInSeriesWithItsOwn`.
constexpr double position_uncertainty = 1e-4;
/// [kg/m³]: objects of another density have a larger or smaller tool than their size asks. Larger: smaller tools. Goes
/// into `Calibration.LengthGrowsWithTheObjectAndWithItsWeight`.
constexpr double density_of_water = 1000.0;

}  // namespace spring_workbench::tools
