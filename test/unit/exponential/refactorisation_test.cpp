// When a linear part is recomputed.
#include "spring_workbench/exponential/refactorisation.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace spring_workbench::exponential::refactorisation_test {
namespace {

using Rule = Refactorisation<2>;
using Strain = Rule::Strain;

/// The number of the first step at which a rule that began at zero wants a new linear part; `at(i)` is the strain at
/// the start of step i = 1, 2, … -1: at none of `steps`.
template <typename At>
int first_due(int steps, const Strain& mass, const At& at) {
  Rule rule;
  rule.restart(Strain::Zero());
  for (int i = 1; i <= steps; ++i) {
    if (rule.is_due(at(i), Strain::Zero(), mass)) return i;
  }
  return -1;
}

/// After as many steps straight away from the linear part, as many would lead back: it is due when they exceed the
/// limit, whatever the length of the steps, the direction and the mass.
TEST(Refactorisation, OfASteadyMotionIsDueWhenItsWayBackIsLongerThanTheLimit) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  for (int trial = 0; trial < 100; ++trial) {
    const double length = std::ldexp(1.0, static_cast<int>(30.0 * unit(random)));  // powers of two: no rounding
    const Strain mass(std::ldexp(1.0, 2 * static_cast<int>(8.0 * unit(random))), 1.0);
    const bool along = unit(random) > 0.0;
    const auto at = [&](int i) { return Strain(along ? i * length : 0.0, along ? 0.0 : -i * length); };
    EXPECT_EQ(first_due(1000, mass, at), static_cast<int>(Rule::max_steps_back) + 1) << length;
  }
}

/// The decision depends on ratios of lengths alone.
TEST(Refactorisation, IsDueAtTheSameStepInAnyUnit) {
  std::mt19937 random(2);
  std::normal_distribution<double> normal;
  for (int trial = 0; trial < 200; ++trial) {
    std::array<Strain, 300> walk;
    Strain x = Strain::Zero();
    for (Strain& at : walk) at = x += Strain(0.3 + normal(random), normal(random));
    const auto at = [&](int i) { return walk[static_cast<std::size_t>(i) - 1]; };
    const int due = first_due(300, {1.0, 1.0}, at);
    EXPECT_EQ(due, first_due(300, {1.0, 1.0}, [&](int i) { return Strain(0x1p-20 * at(i)); }));
    EXPECT_EQ(due, first_due(300, {0x1p24, 0x1p24}, at));
  }
}

/// A motion about the linear part's own strain never asks for another one; one about a strain that is many steps away
/// does; so does one that comes to rest anywhere else, however long that takes.
TEST(Refactorisation, OfAnOscillationDependsOnItsCentre) {
  const auto about = [](double centre) {
    return first_due(100000, {1.0, 1.0},
                     [centre](int i) { return Strain(centre + std::sin(0.3 * i), std::cos(0.3 * i)); });
  };
  EXPECT_EQ(about(0.0), -1);
  EXPECT_EQ(about(5.0), -1);  // a step is 0.3 long
  EXPECT_GT(about(40.0), 1);
  const int at_rest = first_due(100000, {1.0, 1.0}, [](int i) { return Strain(std::min(1.0, 0.1 * i), 0.0); });
  EXPECT_GT(at_rest, 10);
  EXPECT_EQ(first_due(100000, {1.0, 1.0}, [](int) { return Strain(Strain::Zero()); }), -1);
}

/// Slow iterations are paid for by a new linear part once they have cost as much, unless the strain is still that of
/// the current one, which would come out the same.
TEST(Refactorisation, IsDueWhenSlowIterationsHaveCostAsMuch) {
  const Strain mass(1.0, 1.0), away(1e-3, 0.0);
  for (const int iterations : {Rule::fast_iterations, Rule::fast_iterations + 1, 12}) {
    Rule rule, at_rest;
    rule.restart(Strain::Zero());
    at_rest.restart(Strain::Zero());
    int spent = 0;
    bool due = false;
    for (int i = 1; i <= 1000 && !due; ++i) {
      due = rule.is_due(i % 2 == 0 ? away : Strain(-away), Strain::Zero(), mass);
      EXPECT_FALSE(at_rest.is_due(Strain::Zero(), Strain::Zero(), mass));
      EXPECT_EQ(due, spent > Rule::budget) << i;
      rule.add(iterations);
      at_rest.add(iterations);
      spent += iterations - Rule::fast_iterations;
    }
    EXPECT_EQ(due, iterations > Rule::fast_iterations);
  }
}

}  // namespace
}  // namespace spring_workbench::exponential::refactorisation_test
