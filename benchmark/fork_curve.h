#pragma once

#include <string>
#include <vector>

namespace spring_workbench::benchmark {

/// Error against the exact elastica of a curve along which the fork is drawn, and its cost. The curve is computed for
/// the exact tip: deflection, slope and, for `bezier`, shortening.
struct ForkCurveRow {
  std::string curve;          ///< rod (shape model `linear`) or bezier
  std::string load;           ///< cantilever: a transverse force with fixed direction; s_shape: the tip cannot turn
  double alpha = 0.0;         ///< P L² / EI
  double shape_error = 0.0;   ///< largest distance between points of equal arc length, relative to L
  double length_error = 0.0;  ///< error of the drawn length, relative to L
  double curve_us = 0.0;      ///< to make the curve [µs of processor time]
  double deform_us = 0.0;     ///< to deform a fork of `vertices` along it [µs of processor time]
  std::size_t vertices = 0;
};

template <typename Fields>
void each_field(ForkCurveRow& r, Fields& fields) {
  fields(r.curve, r.load, r.alpha, r.shape_error, r.length_error, r.curve_us, r.deform_us, r.vertices);
}

std::vector<ForkCurveRow> measure_fork_curves();
/// The rows as CSV with a header line.
std::string fork_curves_csv(const std::vector<ForkCurveRow>& rows);

}  // namespace spring_workbench::benchmark
