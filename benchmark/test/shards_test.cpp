// A report divided into shards and merged equals the whole report, except for run times.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <random>
#include <sstream>
#include <thread>

#include "benchmark/baselines.h"
#include "benchmark/error_table.h"
#include "benchmark/our_methods.h"
#include "benchmark/report/parts.h"
#include "benchmark/rod_table.h"
#include "benchmark/stability_map.h"
#include "benchmark/stability_table.h"
#include "test/support/temporary_folder.h"

namespace spring_workbench::benchmark::shards_test {
namespace {

using test_support::TemporaryFolder;

/// Writes a file and returns its path.
std::string written(const TemporaryFolder& folder, const std::string& name, const std::string& text) {
  folder.write(name, text);
  return folder.path(name);
}

std::string text_of(const ReportPart& part) {
  std::ostringstream text;
  write_part(part, text);
  return text.str();
}

struct Work {
  ErrorTablePlan scenes = error_table_plan(true);
  RodTablePlan rods = rod_table_plan(true, "");
  StabilityPlan map = stability_plan(true);
  std::vector<MethodPtr> ours = our_methods();
  std::vector<const Method*> methods;

  /// A little of each kind of work; no curve ends by its run time.
  Work() {
    scenes.scenes.resize(2);
    scenes.steps_per_output = {1, 4};
    for (double* longest : {&scenes.longest_run, &rods.longest_run, &rods.longest_coarse_run, &rods.longest_engine_run})
      *longest = std::numeric_limits<double>::infinity();
    scenes.repetition = rods.repetition = {};
    scenes.run_limit = rods.tolerance_time_limit = 60.0;
    for (std::size_t i = 0; i < 3; ++i) methods.push_back(ours[i].get());
    rods.cases.resize(1);
    rods.cases[0].shapes.resize(2);
    rods.steps_per_output = {1, 2};
    rods.tolerances.clear();
    map.integrators = {"rk4", "paper"};
    map.stiffness_factors = {1.0, 1e6, 1e12};
    map.masses = {1.0};
    map.hands = {MapHand::jump};
  }

  /// All tables as text, without run times.
  std::string tables(Units& units) const {
    std::vector<ErrorRow> rows = error_table(methods, scenes, units);
    const std::vector<ErrorRow> more = rod_table(rods, {}, units);
    rows.insert(rows.end(), more.begin(), more.end());
    for (ErrorRow& row : rows) row.wall_us_per_simulated_second = row.other_wall_us = 0.0;
    const StabilityMap stability = stability_map(map, units);
    std::string text;
    for (const ErrorRow& row : rows) text += row_text(row) + '\n';
    for (StabilityRow row : stability.rows) {
      row.real_time = row.three_times = 0;
      text += row_text(row) + '\n';
    }
    for (StabilityRun failure : stability.failures) {
      failure.outcome.processor = 0.0;
      text += row_text(failure) + '\n';
    }
    return text;
  }
};

TEST(Shards, MergedTheyAreTheWholeHoweverManyThereAre) {
  const Work work;
  std::ostringstream log;
  Progress progress(log, false, 1000);
  Units all(progress, Shard{});
  const std::string whole = work.tables(all);
  EXPECT_GT(std::count(whole.begin(), whole.end(), '\n'), 40);
  for (const std::size_t count : {1U, 3U, 50U}) {
    const TemporaryFolder folder;
    std::vector<std::string> paths;
    std::size_t idle = 0;
    for (std::size_t i = count; i >= 1; --i) {
      Units units(progress, Shard{i, count});
      work.tables(units);
      idle += units.kept().empty();
      paths.push_back(written(folder, std::to_string(i),
                              text_of({{i, count},
                                       true,
                                       {100.0 - static_cast<double>(i), 100.0 + static_cast<double>(i), 1.0},
                                       "",
                                       {},
                                       units.kept()})));
    }
    EXPECT_EQ(idle > 0, count == 50);  // more shards than work: some have none, and are merged like the others
    ReportPart parts = read_parts(paths);
    EXPECT_EQ(parts.time.begun, 100.0 - static_cast<double>(count));
    EXPECT_EQ(parts.time.ended, 100.0 + static_cast<double>(count));
    EXPECT_EQ(parts.time.processor, static_cast<double>(count));
    Units merging(progress, std::move(parts.rows));
    EXPECT_EQ(work.tables(merging), whole);
    EXPECT_TRUE(merging.kept().empty());
  }
}

TEST(Shards, WithAQueueEachUnitIsMeasuredOnceByWhoeverIsFree) {
  const Work work;
  std::ostringstream log;
  Progress progress(log, false, 1000);
  const auto of_map = [&](Units& units) {
    std::string text;
    for (StabilityRow row : stability_map(work.map, units).rows) {
      row.real_time = row.three_times = 0;
      text += row_text(row) + '\n';
    }
    return text;
  };
  Units all(progress, Shard{});
  const std::string whole = of_map(all);
  const TemporaryFolder queue, folder;
  std::vector<Units> shards;
  for (std::size_t i = 1; i <= 3; ++i) shards.emplace_back(progress, Shard{i, 3}, queue.path("."));
  std::vector<std::thread> threads;
  for (Units& units : shards) threads.emplace_back([&] { of_map(units); });
  for (std::thread& thread : threads) thread.join();
  std::vector<std::string> paths;
  std::size_t kept = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    kept += shards[i].kept().size();
    EXPECT_EQ(shards[i].times().size(), shards[i].kept().size());
    paths.push_back(written(folder, std::to_string(i), text_of({{i + 1, 3}, true, {}, "", {}, shards[i].kept()})));
  }
  EXPECT_EQ(kept, all.kept().size());
  Units merging(progress, read_parts(paths).rows);
  EXPECT_EQ(of_map(merging), whole);
  double processor = 0.0;
  for (const UnitTime& time : merging.times()) processor += time.processor;
  EXPECT_GT(processor, 0.0);
  EXPECT_EQ(merging.times().size(), all.times().size());
  Units late(progress, Shard{1, 1}, queue.path("."));
  of_map(late);
  EXPECT_TRUE(late.kept().empty());  // all is taken
}

TEST(Shards, EveryBitOfARowComesBack) {
  std::mt19937_64 random(8);
  for (int i = 0; i < 1000; ++i) {
    ErrorRow row;
    const std::uint64_t bits = random();
    std::memcpy(&row.error, &bits, sizeof bits);
    row.step =
        std::vector<double>{-0.0, std::numeric_limits<double>::infinity(), 5e-324}[static_cast<std::size_t>(i % 3)];
    row.scene = i % 2 == 0 ? "" : "C, two";
    row.finite = i % 5 == 0;
    const ErrorRow back = row_from_text<ErrorRow>(row_text(row), "here");
    if (std::isnan(row.error)) {
      EXPECT_TRUE(std::isnan(back.error));
    } else {
      EXPECT_EQ(std::memcmp(&back.error, &bits, sizeof bits), 0);
    }
    EXPECT_EQ(std::memcmp(&back.step, &row.step, sizeof row.step), 0);
    EXPECT_EQ(back.scene, row.scene);
    EXPECT_EQ(back.finite, row.finite);
  }
}

TEST(Shards, WhatIsNotAllShardsOfOneReportIsRefused) {
  const RowsByUnit rows = {{"a unit", UnitRows{{row_text(StabilityCount{"rk4", "A", 1, 2, 3, 4})}, 0.5, ""}}};
  const auto part = [&](std::size_t i, std::size_t count, bool quick) {
    return text_of({{i, count}, quick, {}, "", {{"machine", "this"}}, rows});
  };
  const TemporaryFolder folder;
  const std::string one = written(folder, "one", part(1, 2, true)), two = written(folder, "two", part(2, 2, true));
  EXPECT_EQ(read_parts({two, one}).rows.size(), 1U);
  const std::string text = part(2, 2, true);
  const std::vector<std::vector<std::string>> bad = {
      {one},
      {one, one},
      {one, two, two},
      {one, "/nowhere/at/all"},
      {one, "/"},
      {one, "/dev/null"},
      {one, written(folder, "other count", part(2, 3, true))},
      {one, written(folder, "not quick", part(2, 2, false))},
      {one, written(folder, "something else", "scene,stiffness_factor\nA,1\n")}};
  for (const auto& paths : bad) EXPECT_THROW(read_parts(paths), validation::InputError) << paths.back();
  for (std::size_t length = 0; length < text.size(); ++length) {
    EXPECT_THROW(read_parts({one, written(folder, "cut", text.substr(0, length))}), validation::InputError) << length;
  }
  std::ostringstream log;
  Progress progress(log, false, 1);
  Units units(progress, read_parts({one, two}).rows);
  const auto none = [] { return std::vector<StabilityCount>{}; };
  EXPECT_THROW(units.rows<StabilityCount>(0, "another unit", none), validation::InputError);
  EXPECT_THROW(units.rows<ErrorRow>(0, "a unit", [] { return std::vector<ErrorRow>{}; }), validation::InputError);
}

}  // namespace
}  // namespace spring_workbench::benchmark::shards_test
