#pragma once

#include <cstddef>

// Each with its unit, the effect of a change, and the test that detects it (scripts/mutate).

namespace spring_workbench::geometry {

/// Distance by which the gap along an edge–edge axis must exceed that along a face normal for an edge contact [m]; for
/// flush faces both are equal. If larger, crossed edges are treated as faces. Test: none: no value tried makes one
/// fail.
constexpr double edge_margin = 1e-5;
/// The same as a fraction of the gap between the faces. Test: none: no value tried makes one fail.
constexpr double edge_margin_fraction = 0.05;
/// Distance by which a contact must be deeper than one of the four that are kept to replace it [m]. Test: none: no
/// value tried makes one fail.
constexpr double depth_advantage = 1e-6;
/// Fraction of a path; what a new separating plane adds is looked for until it adds less. If larger, bodies that turn
/// towards each other are stopped although they do not touch. Test:
/// ClearWay.WithANewPlaneWhereTheLastOneEndsItLeadsToTheTouch at 1.
constexpr double least_advance = 0.01;
/// Distance below which contacts of two solids with the same normal are merged [m]. If smaller, a contact at a seam
/// within a face is found twice. Test: Solids.FlushFacesTouchWithTheirCornersOnce at 0.
constexpr double same_place = 1e-7;
/// Sine of the angle below which two directions count as parallel: the edge between two such faces is a seam that
/// touches nothing, and two such edges do not cross. If smaller, rounding turns seams into edges. Test:
/// Solids.SeamsAndGroovesAreNoEdges at 0, 1.
constexpr double parallel = 1e-6;
/// Largest slope between two faces at which all their corners count as contacts. If smaller, a slightly tilted body
/// lands on one corner; if larger, other faces count, too. Test: Drops.WithoutRestitutionNothingLeavesTheBench at 0.
constexpr double slope_of_flush = 0.1;
/// Steps along a rim towards its point nearest to an edge; each divides the distance by about the radius over the gap.
/// Fewer: contacts of rims are missed. Test: Solids.ACylinderThatOverlapsABoxHasANormalThatSeparatesThem at 1.
constexpr int max_turns = 30;
/// Number of sides of the prism that approximates a cylinder in triangle contact. If fewer, it is less round; if more,
/// contact is slower. Test: Pairs.AFlushCylinderStandsOnThePointsOfItsRim at 0.
constexpr int cylinder_sides = 48;
/// Cosine of the angle between two triangles below which their edge is drawn smooth. If larger, round meshes have
/// facets. Test: Meshes.AreSmoothBelowTheCrease.
constexpr float crease_cosine = 0.7F;
/// Largest number of triangles at a vertex that is drawn smooth, because a fan of n costs n². If smaller, the tips of
/// cones have facets. Test: Meshes.AreSmoothBelowTheCrease at 4, 200.
constexpr std::size_t max_smoothed_triangles = 64;

}  // namespace spring_workbench::geometry
