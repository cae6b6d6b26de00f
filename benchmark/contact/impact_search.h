#pragma once

#include <string>
#include <vector>

namespace spring_workbench::benchmark {

/// Accuracy of the search for the pose of first contact, for random motions of a box that falls onto a plane while
/// turning.
struct ImpactRow {
  std::string pair;            ///< box on bench, box on box, mesh on mesh: the same plane each time
  int levels = 0;              ///< levels of bisection; 0: time of impact
  double mean_error = 0.0;     ///< [m] largest distance of a corner in the pose found from the exact pose
  double largest_error = 0.0;  ///< [m]
  int through = 0;             ///< motions whose resulting pose penetrates by more than the tolerance of the search
  double cpu_us = 0.0;         ///< processor time of a search [µs]
};

template <typename Fields>
void each_field(ImpactRow& r, Fields& fields) {
  fields(r.pair, r.levels, r.mean_error, r.largest_error, r.through, r.cpu_us);
}

/// Runs `ways` seeded motions of 40 mm (2 m/s at 50 Hz) and up to 1 rad of a box of 100 × 60 × 40 mm, with 2 … 16
/// levels and with time of impact. Exact solution: the first moment at which a corner is as deep as the search
/// tolerates (1 µm).
std::vector<ImpactRow> measure_impact_search(int ways);

}  // namespace spring_workbench::benchmark
