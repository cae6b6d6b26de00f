#include "benchmark/verdicts.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <tuple>

namespace spring_workbench::benchmark {
namespace {

/// A method of order four in scene C: `scale` µs/s at an error of 1e-6 of the amplitude.
void add_line(const std::string& method, double factor, double scale, std::vector<ErrorRow>& rows) {
  for (int i = -4; i <= 4; ++i) {
    ErrorRow row;
    row.scene = "C";
    row.stiffness_factor = factor;
    row.method = method;
    row.finite = true;
    row.wall_us_per_simulated_second = scale * std::pow(1.9, i);
    row.error_over_hand_amplitude = 1e-6 * std::pow(1.9, -4.0 * i);
    rows.push_back(row);
  }
}

Verdict::Result result_of(const Measurements& measured, const std::string& part) {
  const std::vector<Verdict> all = verdicts(measured);
  const auto found =
      std::find_if(all.begin(), all.end(), [&](const Verdict& v) { return v.claim.find(part) != std::string::npos; });
  if (found == all.end()) throw std::runtime_error("no verdict on " + part);
  return found->result;
}

TEST(Verdicts, ARatioIsHeldFromItsTargetOnAndNotBelow) {
  for (const auto& [factor, target] : {std::pair{1.0, 20.0}, std::pair{100.0, 50.0}, std::pair{1e4, 50.0}}) {
    for (const double share : {0.99, 1.01}) {
      Measurements measured;
      add_line("exponential", factor, 10.0, measured.scenes);
      add_line("ode_erp_cfm", factor, 10.0 * target * share, measured.scenes);
      add_line("hand_rk4", factor, 1.0, measured.scenes);  // no engine
      const auto wanted = share > 1.0 ? Verdict::Result::pass : Verdict::Result::fail;
      EXPECT_EQ(result_of(measured, "best engine over ours"), wanted) << factor << ' ' << share;
    }
  }
}

TEST(Verdicts, ARunThatKnowsTheHandByPosesAloneIsNotHeldAgainstThePeers) {
  Measurements measured;
  add_line("exponential", 100.0, 1.0, measured.scenes);
  for (ErrorRow& row : measured.scenes) row.hand = "samples";
  add_line("ode_erp_cfm", 100.0, 1e6, measured.scenes);
  EXPECT_EQ(result_of(measured, "best engine over ours"), Verdict::Result::fail);
}

TEST(Verdicts, OneCellThatFailsIsEnoughForTheMapNotToHold) {
  Measurements measured;
  StabilityRow row{"exponential", "linear"};
  row.cells = row.finite = row.bounded = row.energy_kept = row.none_refused = row.held = 40;
  measured.map.rows = {row, row};
  EXPECT_EQ(result_of(measured, "Stability map, exponential"), Verdict::Result::pass);
  for (int StabilityRow::*count : {&StabilityRow::finite, &StabilityRow::bounded, &StabilityRow::energy_kept}) {
    measured.map.rows[1] = row;
    --(measured.map.rows[1].*count);
    EXPECT_EQ(result_of(measured, "Stability map, exponential"), Verdict::Result::fail);
  }
}

TEST(Verdicts, OneCellThatFailsIsEnoughForContactsExtremesNotToHold) {
  Measurements measured;
  measured.extremes.assign(2, {"stack", "stop", 1e3, 0.02, 0, {}});
  EXPECT_EQ(result_of(measured, "Contact at its extremes, stop"), Verdict::Result::pass);
  measured.extremes[1].outcome.penetration = 1.01e-4;
  EXPECT_EQ(result_of(measured, "Contact at its extremes, stop"), Verdict::Result::fail);
}

TEST(Verdicts, ErrorsOfTheRodAreJudgedInPositionAndAngle) {
  for (const auto& [error, angle, held] :
       {std::tuple{0.9e-5, 0.9e-4, true}, std::tuple{1.1e-5, 0.0, false}, std::tuple{0.0, 1.1e-4, false}}) {
    Measurements measured;
    ErrorRow row;
    row.scene = "underdamped";
    row.shape = "linear";
    row.method = "exponential";
    row.step = 0.02;
    row.finite = true;
    row.error = error;
    row.angle_error = angle;
    measured.rods = {row};
    EXPECT_EQ(result_of(measured, "Rod underdamped"), held ? Verdict::Result::pass : Verdict::Result::fail);
  }
}

TEST(Verdicts, WhatWasNotMeasuredIsNotHeld) {
  for (const Verdict& verdict : verdicts(Measurements())) {
    EXPECT_TRUE(verdict.result == Verdict::Result::not_measured || verdict.claim == "report") << verdict.claim;
  }
}

}  // namespace
}  // namespace spring_workbench::benchmark
