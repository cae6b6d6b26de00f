#pragma once

#include <cstddef>

// Each with its unit, what changing it does, and the test that notices (scripts/mutate).

namespace spring_workbench::collision {

/// [m] of the path, between the free and the touching end of a time of impact. Test: Sweep.TheTimeOfImpactIsExact at
/// 1e-06.
constexpr double impact_precision = 1e-8;
/// Conservative advances before the rest of a path is halved. Fewer: more queries. Test: Sweep.TheTimeOfImpactIsExact
/// at 0.
constexpr int max_advances = 50;
/// Of a shape on the bench that are kept as they are; of more, those furthest out are. Fewer: a box loses corners.
/// Test: Bench.FlushFacesGivePointsThatSpanThem at 1.
constexpr std::size_t max_bench_points = 8;
/// [m]; contacts nearer to each other are one. Test: Pairs.MeshesOfBoxesTouchAsTheBoxesDo at 0.
constexpr double same_place = 1e-7;
/// Sine of the angle at an edge, below which it is a seam within a face and touches nothing. Test:
/// Pairs.MeshesOfBoxesTouchAsTheBoxesDo at 1.
constexpr double flat_edge = 1e-6;
/// Cosine to how two surfaces meet on the whole; a contact normal that goes along it less is none. Test:
/// Pairs.HowFinelyAFloorIsCutDoesNotShow at 5.
constexpr double min_along = 0.5;
/// Of that cosine; of normals that differ by less the shallowest is taken. Test: Pairs.HowFinelyAFloorIsCutDoesNotShow
/// at 10.
constexpr double as_good = 0.1;
/// [m] depth up to which a box and a cylinder touch by their features; deeper ones by their triangles. Smaller: a
/// cylinder that starts deep comes out of a prism; larger: an edge that is far behind a face pushes, too. Test:
/// Pairs.ACylinderIsAsDeepInABoxAsItsLowestPoint at 1e-5.
constexpr double deepest_of_features = 1e-3;

}  // namespace spring_workbench::collision
