#pragma once

#include <cstddef>

// Each with its unit, what changing it does, and the test that notices (scripts/mutate).

namespace spring_workbench::geometry {

/// [m] by which the gap between two edges must exceed that between two faces for the edges to be the contact: for flush
/// faces both are equal. Larger: crossed edges are taken for faces. Test: none: no value tried makes one fail.
constexpr double edges_by = 1e-5;
/// The same as a fraction of the gap between the faces. Test: none: no value tried makes one fail.
constexpr double edges_by_share = 0.05;
/// [m] by which a contact must be deeper than one of the four that are kept to replace it. Test: none: none that was
/// tried fails.
constexpr double stands_out = 1e-6;
/// [m]; two contacts of solids that are nearer to each other, with one normal, are one. Smaller: what touches a seam
/// within a face is found twice. Test: Solids.FlushFacesTouchWithTheirCornersOnce at 0.
constexpr double same_place = 1e-7;
/// Sine of the angle below which two directions are one: two faces, with an edge between that is a seam and touches
/// nothing; two edges, which do not cross. Smaller: rounding makes edges of seams. Test:
/// Solids.SeamsAndGroovesAreNoEdges at 0, 1.
constexpr double parallel = 1e-6;
/// Largest slope between two faces that come to lie on each other with all their corners. Smaller: a body that lands
/// more tilted touches with one corner; larger: other faces count, too. Test:
/// Drops.WithoutRestitutionNothingLeavesTheBench at 0.
constexpr double slope_of_flush = 0.1;
/// Of the prism that stands for a cylinder among triangles. Fewer: less round; more: slower. Test:
/// Pairs.AFlushCylinderStandsOnThePointsOfItsRim at 0.
constexpr int cylinder_sides = 48;
/// cosine of the angle between two triangles below which their edge is drawn smooth. Greater: round meshes have facets.
/// Test: Meshes.AreSmoothBelowTheCrease.
constexpr float crease_cosine = 0.7F;
/// triangles at a vertex up to which it is drawn smooth: making a fan of n takes n². Fewer: the tips of cones have
/// facets. Test: Meshes.AreSmoothBelowTheCrease at 4, 200.
constexpr std::size_t most_smoothed = 64;

}  // namespace spring_workbench::geometry
