// The contact part of the report: its scenes against exact results.
#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <map>
#include <set>

#include "benchmark/baselines.h"
#include "benchmark/contact/impact_search.h"
#include "benchmark/contact/motion_steps.h"
#include "benchmark/contact/product_map.h"

namespace spring_workbench::benchmark::contact_test {
namespace {

TEST(Drag, OursLagAsCoulombsLawSaysWithOneStepASample) {
  for (const DragMethod& method : our_drags()) {
    for (const double factor : {1.0, 1e4}) {
      DragScene scene;
      scene.stiffness_factor = factor;
      const DragRow row = run_drag(method, scene, 0.02, 1);
      ASSERT_TRUE(row.finite) << method.name;
      EXPECT_LT(row.lag_error, 1e-3) << method.name << " " << factor;
      EXPECT_LT(row.penetration, 1e-5) << method.name << " " << factor;
    }
  }
}

TEST(Drag, EveryEngineIsGivenTheSameScene) {
  // With small steps and without rocking, all methods agree on the lag, since they have the same springs, weight and
  // friction.
  const Baselines baselines = all_baselines();
  if (baselines.drags.empty()) GTEST_SKIP() << "no engine was found";
  ASSERT_GE(baselines.drags.size(), baselines.found.size() - 1);  // at least one of each engine; SUNDIALS is none
  for (const DragMethod& method : baselines.drags) {
    DragScene scene;
    scene.turns = !method.can_lock_turning;
    const DragRow row = run_drag(method, scene, 5e-4, 1);
    ASSERT_TRUE(row.finite) << method.name;
    EXPECT_LT(row.lag_error, 2e-3) << method.name;
  }
}

TEST(Drag, MujocosSolverIsNotDoneEarlierForTheWeightOfItsHand) {
  // Its tolerance is a multiple of the mean inertia. By that of the hand it ends too early, and the box rocks.
  const Baselines baselines = all_baselines();
  for (const DragMethod& method : baselines.drags) {
    if (method.name.find("mujoco") != 0) continue;
    const DragRow row = run_drag(method, DragScene(), 1e-3, 1);
    ASSERT_TRUE(row.finite) << method.name;
    EXPECT_LT(row.lag_error, 2e-3) << method.name;
  }
}

TEST(ImpactSearch, HalvesItsErrorWithEachLevelAndNeverGoesThrough) {
  std::map<std::pair<std::string, int>, ImpactRow> rows;
  for (const ImpactRow& row : measure_impact_search(40)) {
    rows[{row.pair, row.levels}] = row;
    EXPECT_EQ(row.through, 0) << row.pair << " " << row.levels;
  }
  for (const char* pair : {"box on bench", "box on box", "mesh on mesh"}) {
    for (int levels = 2; levels < 16; levels += 2) {
      const double ratio = rows.at({pair, levels}).mean_error / rows.at({pair, levels + 2}).mean_error;
      EXPECT_GT(ratio, 2.0) << pair << " " << levels;
      EXPECT_LT(ratio, 8.0) << pair << " " << levels;
    }
    EXPECT_LT(rows.at({pair, 0}).largest_error, 3e-6) << pair;
  }
}

TEST(ContactMap, HasEveryPairOfValues) {
  const std::vector<std::size_t> values{12, 13, 4, 4, 4, 3, 3, 2};
  std::map<std::pair<std::size_t, std::size_t>, std::set<std::pair<double, double>>> pairs;
  for (const MapCell& c : map_cells(200)) {
    const std::vector<double> v{c.stiffness,
                                c.mass_ratio,
                                c.step,
                                c.damping,
                                static_cast<double>(c.scene),
                                c.friction,
                                static_cast<double>(c.shape),
                                static_cast<double>(c.contact)};
    ASSERT_EQ(v.size(), values.size());
    for (std::size_t a = 0; a < v.size(); ++a) {
      for (std::size_t b = 0; b < a; ++b) pairs[{a, b}].insert({v[a], v[b]});
    }
  }
  for (const auto& [of, met] : pairs)
    EXPECT_EQ(met.size(), values[of.first] * values[of.second]) << of.first << of.second;
}

TEST(ContactMap, ACellThatMissesOneOfItsBoundsDoesNotHold) {
  const MapRow row = run({1e3, 1.0, 0.02, 1.0, 0});
  EXPECT_TRUE(row.holds()) << row.depth << ' ' << row.moved << ' ' << row.steps_blocked;
  EXPECT_GT(row.moved, 0.005);  // at least across the gap
  EXPECT_GT(row.times_real, 0.0);
  const auto with = [&](const std::function<void(MapRow&)>& change) {
    MapRow changed = row;
    change(changed);
    return changed.holds();
  };
  EXPECT_FALSE(with([](MapRow& r) { r.finite = false; }));
  EXPECT_FALSE(with([](MapRow& r) { r.to_the_end = false; }));
  EXPECT_FALSE(with([](MapRow& r) { r.depth = 1.01e-4; }));
  EXPECT_FALSE(with([](MapRow& r) { r.moved = 0.51; }));
  EXPECT_FALSE(with([](MapRow& r) { r.steps_blocked = 1; }));
  EXPECT_FALSE(with([](MapRow& r) { r.steps_unsolved = 1; }));
  EXPECT_FALSE(with([](MapRow& r) { r.steps_rejected = 1; }));
  EXPECT_FALSE(with([](MapRow& r) { r.times_real = 3.1; }));
}

TEST(MotionSteps, EveryMotionStaysNearItsExactRun) {
  const std::vector<MotionStepRow> rows = measure_motion_steps(true);
  if (rows.empty()) GTEST_SKIP() << "built without Bullet";
  std::map<std::string, std::vector<double>> shares;
  for (const MotionStepRow& row : rows) {
    if (row.against == "exact") shares[row.scene].push_back(row.error_share);
  }
  ASSERT_EQ(shares.size(), 6u);  // three motions in two contact modes
  for (const auto& [scene, share] : shares) {
    const bool stop = scene.find(", stop") != std::string::npos;
    EXPECT_LT(*std::max_element(share.begin(), share.end()), stop ? 1e-4 : 0.02) << scene;
  }
}

}  // namespace
}  // namespace spring_workbench::benchmark::contact_test
