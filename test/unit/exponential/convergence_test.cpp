// When a fixed-point iteration ends, and whether it has converged.
#include "spring_workbench/exponential/convergence.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace spring_workbench::exponential::convergence_test {
namespace {

/// An iteration whose changes are `changes(1)`, `changes(2)`, … with a collocation error of `error` and rounding errors
/// of `rounding`; `cancelled`: those of terms that cancel.
struct Iteration {
  bool converged = false;
  int iterations = 0;

  template <typename Changes>
  Iteration(Convergence& convergence, double error, double rounding, double cancelled, const Changes& changes) {
    convergence.begin_step();
    while (!convergence.ended()) {
      const double change = changes(++iterations);
      convergence.add(change * change, change * change, rounding * rounding, [&] { return cancelled * cancelled; });
      if (convergence.may_end()) convergence.set_error(error * error);
    }
    converged = convergence.converged();
    EXPECT_EQ(convergence.iterations(), iterations);
  }
};

/// Of a geometric sequence of changes it is known how much is left after the last: what is accepted has less left than
/// a tenth of the collocation error, and the next step, which knows that error, ends as soon as a fiftieth is left.
TEST(Convergence, LeavesAFractionOfTheCollocationError) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  int accepted = 0;
  for (int trial = 0; trial < 5000; ++trial) {
    const double rate = 0.65 * unit(random), error = std::pow(10.0, -9.0 * unit(random));
    const auto left_after = [rate](int i) {
      return std::pow(rate, i) / (1.0 - rate);
    };  // Σ of the changes from i + 1 on
    const auto change = [rate](int i) { return std::pow(rate, i - 1); };
    Convergence convergence;
    convergence.restart();
    for (int step = 0; step < 3; ++step) {
      const Iteration run(convergence, error, 0.0, 0.0, change);
      const double left = left_after(run.iterations);
      EXPECT_EQ(run.converged, left <= Convergence::max_fraction * error * (1.0 + 1e-9)) << rate << " " << error;
      if (run.converged) ++accepted;
      EXPECT_TRUE(run.converged || run.iterations == Convergence::max_iterations) << rate << " " << error;
      if (step == 0 || run.iterations < 3 || run.iterations == Convergence::max_iterations) continue;
      EXPECT_LE(left, Convergence::fraction_to_end * error * (1.0 + 1e-9)) << rate;  // an iteration less: more is left
      EXPECT_GT(left_after(run.iterations - 1), Convergence::fraction_to_end * error * (1.0 - 1e-9)) << rate;
    }
  }
  EXPECT_GT(accepted, 5000);
}

/// A step after a new linear part converges much faster than those that follow, which need only one iteration: what is
/// accepted is converged, although no step tells how the rate has grown.
TEST(Convergence, DoesNotRelyOnTheRateOfAnOldStep) {
  constexpr double rounding = 1e-13, start = 1e-9;
  Convergence convergence;
  convergence.restart();
  int single = 0;
  for (int step = 0; step < 60; ++step) {
    const double rate = 1e-8 * std::pow(1.25, step);
    const Iteration run(convergence, 0.0, rounding, 0.0, [&](int i) { return start * std::pow(rate, i - 1); });
    EXPECT_TRUE(run.converged) << step;
    EXPECT_LE(start * std::pow(rate, run.iterations) / (1.0 - rate), rounding) << step;
    if (run.iterations == 1) ++single;
  }
  EXPECT_GT(single, 30);
}

/// In other units all decisions are the same.
TEST(Convergence, DependsOnRatiosAlone) {
  std::mt19937 random(2);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  for (int trial = 0; trial < 1000; ++trial) {
    const double rate = 1.2 * unit(random), error = std::pow(10.0, -9.0 * unit(random));
    const double rounding = 1e-12 * unit(random);
    Convergence a, b;
    a.restart();
    b.restart();
    const auto change = [rate](int i) { return std::pow(rate, i - 1); };
    const auto scaled = [&](int i) { return 0x1p-30 * change(i); };
    const Iteration of_a(a, error, rounding, 0.0, change), of_b(b, 0x1p-30 * error, 0x1p-30 * rounding, 0.0, scaled);
    EXPECT_EQ(of_a.converged, of_b.converged);
    EXPECT_EQ(of_a.iterations, of_b.iterations);
  }
}

/// Changes that have come down to the rounding errors need not become smaller; changes that stall above them do not
/// converge, unless they are the rounding errors of terms that cancel.
TEST(Convergence, EndsAtTheRoundingErrors) {
  const auto stalls = [](int i) { return i == 1 ? 1e-11 : i == 2 ? 4e-12 : i % 2 == 0 ? 1e-12 : 2e-12; };
  for (const double rounding : {1e-9, 1e-11, 1e-13}) {
    Convergence convergence;
    convergence.restart();
    const Iteration run(convergence, 0.0, rounding, 0.0, stalls);
    EXPECT_EQ(run.converged, rounding > 5e-12) << rounding;
    convergence.restart();
    EXPECT_TRUE(Iteration(convergence, 0.0, rounding, 1e-11, stalls).converged) << rounding;
  }
}

/// What diverges, or converges so slowly that the step would be no use, is given up.
TEST(Convergence, GivesUpWhatDoesNotConverge) {
  for (const double rate : {0.8, 1.0, 2.0}) {
    Convergence convergence;
    convergence.restart();
    const Iteration run(convergence, 1e-6, 1e-15, 0.0, [rate](int i) { return std::pow(rate, i - 1); });
    EXPECT_FALSE(run.converged) << rate;
    EXPECT_LT(run.iterations, Convergence::max_iterations) << rate;
  }
}

}  // namespace
}  // namespace spring_workbench::exponential::convergence_test
