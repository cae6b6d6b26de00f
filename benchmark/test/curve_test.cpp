#include "benchmark/curve.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <random>
#include <sstream>

#include "benchmark/report/tables.h"

namespace spring_workbench::benchmark::curve_test {
namespace {

TEST(Curve, APowerLawIsInterpolatedExactlyWhateverItsOrderAndTheOrderOfThePoints) {
  std::mt19937 random(1);
  for (const double order : {1.0, 2.0, 4.0}) {
    std::vector<CurvePoint> points;
    for (double time = 10.0; time < 1e5; time *= 2.0) points.push_back({time, 3.0 * std::pow(time, -order)});
    std::shuffle(points.begin(), points.end(), random);
    for (const double time : {11.0, 123.0, 4567.0}) {
      const auto found = run_time_for_error(points, 3.0 * std::pow(time, -order));
      ASSERT_TRUE(found);
      EXPECT_NEAR(*found, time, 1e-9 * time);
    }
  }
}

TEST(Curve, PointsThatAnotherBeatsInBothChangeNothing) {
  const std::vector<CurvePoint> front = {{1.0, 1e-2}, {10.0, 1e-4}, {100.0, 1e-8}};
  std::vector<CurvePoint> all = front;
  for (const CurvePoint& point : front) all.push_back({1.5 * point.run_time, 2.0 * point.error});
  for (const double error : {1e-3, 1e-5, 1e-7})
    EXPECT_EQ(run_time_for_error(all, error), run_time_for_error(front, error));
}

TEST(Curve, NothingIsExtrapolated) {
  const std::vector<CurvePoint> points = {{5.0, 1e-3}, {50.0, 1e-6}};
  EXPECT_EQ(run_time_for_error(points, 1.0), 5.0);
  EXPECT_FALSE(run_time_for_error(points, 1e-7));
  EXPECT_FALSE(run_time_for_error({}, 1.0));
  EXPECT_TRUE(run_time_for_error({{1.0, 1e-3}, {2.0, 0.0}}, 1e-9));  // an error of zero has no logarithm
}

ErrorRow row(const std::string& method, double time, double error, bool finite = true) {
  ErrorRow r;
  r.scene = "C";
  r.stiffness_factor = 100.0;
  r.mass = 5.0;
  r.method = method;
  r.wall_us_per_simulated_second = time;
  r.error = r.error_over_hand_amplitude = error;
  r.error_over_largest_deflection = 10.0 * error;
  r.finite = finite;
  return r;
}

TEST(Curve, TableOfRunTimesHasALineForEachMethodAndAColumnForEachSceneMassAndHand) {
  std::vector<ErrorRow> rows = {row("m", 1.0, 1e-2), row("m", 100.0, 1e-6), row("m", 2.0, 0.0, false),
                                row("n", 7.0, 1e-3)};
  rows.push_back(row("m", 9.0, 1e-4));
  rows.back().hand = "samples";
  rows.push_back(row("n", 3.0, 1e-5));
  rows.back().mass = 2.0;
  EXPECT_EQ(run_time_for_error_csv(rows, 1e-4, &ErrorRow::error_over_hand_amplitude),
            "method,\"C × 100, 5 kg, hand by function\",\"C × 100, 5 kg, hand by samples\","
            "\"C × 100, 2 kg, hand by function\"\nm,10,9,-\nn,-,-,3\n");
  EXPECT_EQ(run_time_for_error_csv(rows, 1e-5, &ErrorRow::error_over_largest_deflection),
            "method,\"C × 100, 5 kg, hand by function\",\"C × 100, 5 kg, hand by samples\","
            "\"C × 100, 2 kg, hand by function\"\nm,100,-,-\nn,-,-,-\n");
}

TEST(ErrorTable, ALineEndsAtItsFloorAtItsReferenceOrWhenItTakesTooLong) {
  std::vector<ErrorRow> rows;
  double error = 1e-3;
  for (int i = 0; i < 10; ++i, error *= 0.5) {
    rows.push_back(row("first order", 1.0, error));
    EXPECT_FALSE(line_is_over(rows, 1.0));
  }
  for (int i = 0; i < 2; ++i) {
    rows.push_back(row("first order", 1.0, error * 2.0));
    EXPECT_FALSE(line_is_over(rows, 1.0));
  }
  rows.push_back(row("first order", 1.0, error * 2.0));
  EXPECT_TRUE(line_is_over(rows, 1.0));
  // Tolerances that one step per sample keeps have no effect, and finer ones do.
  for (ErrorRow& one : rows) one.tolerance = 1e-3;
  EXPECT_FALSE(line_is_over(rows, 1.0));
  EXPECT_TRUE(line_is_over({row("slow", 2e6, 1e-3)}, 1.0));
  rows = {row("exact", 1.0, 1e-9)};
  rows[0].reference_uncertainty = 1e-9;
  EXPECT_TRUE(line_is_over(rows, 1.0));
  EXPECT_FALSE(line_is_over({row("unstable", 0.0, 0.0, false)}, 1.0));
}

/// A method that works from `limit` steps per output on has its first row within a quarter of that, wherever it is.
TEST(ErrorTable, ALineBeginsWithinAQuarterOfItsFirstStepOfUse) {
  for (int limit = 2; limit <= 300; limit += limit / 8 + 1) {
    for (const bool finite : {false, true}) {  // failed runs are not finite, or have an error above the deflection
      const auto made = [&](int n) {
        const bool works = n >= limit;
        ErrorRow r = row("explicit", 1.0, works ? 1e-3 : 2.0, works || finite);
        r.error_over_largest_deflection = r.error;
        r.step = 0.02 / n;
        return r;
      };
      std::vector<ErrorRow> rows;
      for (int n = 1; n < 2 * limit; n *= 2) {
        rows.push_back(made(n));
        find_begin(rows, 0.02, made);
      }
      const auto first = std::find_if(rows.begin(), rows.end(), [](const ErrorRow& r) { return r.error < 1.0; });
      ASSERT_NE(first, rows.end());
      EXPECT_LE(0.02 / first->step, std::max(1.25 * limit, limit + 0.5)) << limit;
      EXPECT_LE(rows.size(), 13U) << limit;
      for (std::size_t i = 1; i < rows.size(); ++i) EXPECT_LT(rows[i].step, rows[i - 1].step) << limit;
    }
  }
}

TEST(ErrorTable, MethodsTakeTurnsSettingBySettingAndSoDoTheirRowsWhenTheyAreTimedAgain) {
  std::string order;
  std::vector<ErrorRow> rows;
  std::vector<std::function<bool()>> lines;
  for (const auto& [name, settings] : {std::pair{'a', 3}, std::pair{'b', 1}, std::pair{'c', 2}}) {
    for (int i = 0; i < settings; ++i) rows.push_back(row(std::string(1, name), 1.0, 1e-3));
    lines.emplace_back([&order, name = name, left = settings]() mutable {
      if (left-- <= 0) return false;
      order += name;
      return true;
    });
  }
  take_turns(lines);
  EXPECT_EQ(order, "abcaca");
  std::string again;
  for (const std::size_t i : in_turns(rows)) again += rows[i].method;
  EXPECT_EQ(again, order);
}

TEST(ErrorTable, CsvHasEachFigureUnderItsName) {
  std::vector<ErrorRow> rows = {row("m", 12.5, 0.25), row("n", 1.0, 1.0, false)};
  rows[0].step = 0.02;
  rows[0].angle_error = 3.0;
  rows[0].position_error = 0.125;
  rows[0].error_between = 0.0625;
  rows[0].hand = "samples";
  std::stringstream csv;
  write_rows(rows, csv);
  const auto cells = [&] {
    std::string line, cell;
    std::getline(csv, line);
    std::istringstream in(line + ',');
    std::vector<std::string> found;
    while (std::getline(in, cell, ',')) found.push_back(cell);
    return found;
  };
  const std::vector<std::string> names = cells(), first = cells(), second = cells();
  ASSERT_EQ(first.size(), names.size());
  ASSERT_EQ(second.size(), names.size());
  const std::map<std::string, std::pair<std::string, std::string>> wanted = {
      {"scene", {"C", "C"}},
      {"stiffness_factor", {"100", "100"}},
      {"method", {"m", "n"}},
      {"shape", {"bushing", "bushing"}},
      {"hand", {"samples", "function"}},
      {"step", {"0.02", ""}},
      {"tolerance", {"", ""}},
      {"error", {"0.25", ""}},
      {"position_error", {"0.125", ""}},
      {"error_between", {"0.0625", ""}},
      {"angle_error", {"3", ""}},
      {"error_over_largest_deflection", {"2.5", ""}},
      {"wall_us_per_simulated_second", {"12.5", ""}},
      {"finite", {"1", "0"}}};
  std::size_t seen = 0;
  for (std::size_t i = 0; i < names.size(); ++i) {
    const auto found = wanted.find(names[i]);
    if (found == wanted.end()) continue;
    ++seen;
    EXPECT_EQ(first[i], found->second.first) << names[i];
    EXPECT_EQ(second[i], found->second.second) << names[i];
  }
  EXPECT_EQ(seen, wanted.size());
}

}  // namespace
}  // namespace spring_workbench::benchmark::curve_test
