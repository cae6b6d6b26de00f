#pragma once

#include <string>
#include <vector>

namespace spring_workbench::benchmark {

/// How the search for the pose of first contact did on random ways of a box that falls on a plane as it turns.
struct ImpactRow {
  std::string pair;  ///< box on bench, box on box, mesh on mesh: the same plane each time
  int levels = 0;    ///< of bisection; 0: time of impact
  double mean_error =
      0.0;  ///< [m] from a corner of the free pose found to where it is in the exact one, largest corner
  double largest_error = 0.0;  ///< [m]
  int through = 0;             ///< ways whose free pose is deeper than the search's tolerance
  double cpu_us = 0.0;         ///< of a search
};

template <typename Fields>
void each_field(ImpactRow& r, Fields& fields) {
  fields(r.pair, r.levels, r.mean_error, r.largest_error, r.through, r.cpu_us);
}

/// Ways of 40 mm (2 m/s at 50 Hz) and up to 1 rad of a box of 100 × 60 × 40 mm, `ways` of them, seeded, for 2 … 16
/// levels and time of impact. Exact: the first moment at which a corner is as deep as the search takes for free (1 µm).
std::vector<ImpactRow> measure_impact_search(int ways);

}  // namespace spring_workbench::benchmark
