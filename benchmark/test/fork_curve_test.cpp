#include "benchmark/fork_curve.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>

namespace spring_workbench::benchmark::fork_curve_test {
namespace {

TEST(ForkCurves, ErrorsVanishWithTheLoadAndTheLengthStays) {
  std::map<std::string, ForkCurveRow> heavier;  // by curve and load
  for (const ForkCurveRow& row : measure_fork_curves()) {
    const std::string key = row.curve + row.load;
    EXPECT_LT(row.length_error, 1e-4) << key << row.alpha;
    EXPECT_GT(row.vertices, 10000u);
    EXPECT_GT(row.shape_error, 0.0);
    const auto lighter = heavier.find(key);
    if (lighter != heavier.end()) {
      const double order =
          std::log(row.shape_error / lighter->second.shape_error) / std::log(row.alpha / lighter->second.alpha);
      EXPECT_GT(order, row.alpha <= 1.0 ? 2.5 : 0.3) << key << row.alpha;  // at small loads, of third order
    }
    heavier[key] = row;
  }
  EXPECT_EQ(heavier.size(), 4u);
}

TEST(ForkCurves, TableHasALineForEach) {
  ForkCurveRow row;
  row.curve = "rod";
  row.load = "cantilever";
  EXPECT_EQ(fork_curves_csv({row, row}),
            "curve,load,alpha,shape_error,length_error,curve_us,deform_us,vertices\n"
            "rod,cantilever,0,0,0,0,0,0\nrod,cantilever,0,0,0,0,0,0\n");
}

}  // namespace
}  // namespace spring_workbench::benchmark::fork_curve_test
