#pragma once

#include <string>
#include <vector>

namespace spring_workbench::benchmark {

/// How far a curve that the fork is drawn along is off the exact elastica, and what it costs. The curve is driven by
/// the exact tip: deflection and slope, and, for `bezier`, the shortening too.
struct ForkCurveRow {
  std::string curve;          ///< rod (shape model `linear`) or bezier
  std::string load;           ///< cantilever: a transverse force that keeps its direction; s_shape: the tip cannot turn
  double alpha = 0.0;         ///< P L² / EI
  double shape_error = 0.0;   ///< largest distance of points of equal arc length, over L
  double length_error = 0.0;  ///< of the drawn curve, over L
  double curve_us = 0.0;      ///< to make the curve [µs of processor time]
  double deform_us = 0.0;     ///< to deform a fork of `vertices` along it [µs of processor time]
  std::size_t vertices = 0;
};

template <typename Fields>
void each_field(ForkCurveRow& r, Fields& fields) {
  fields(r.curve, r.load, r.alpha, r.shape_error, r.length_error, r.curve_us, r.deform_us, r.vertices);
}

std::vector<ForkCurveRow> measure_fork_curves();
/// As CSV, with a header line.
std::string fork_curves_csv(const std::vector<ForkCurveRow>& rows);

}  // namespace spring_workbench::benchmark
