#include <gtest/gtest.h>

#include <random>
#include <utility>
#include <vector>

#include "spring_workbench/bodies/body_state.h"

namespace spring_workbench::bodies::changes_test {
namespace {

/// A simple model: stores the number of each object's last change.
struct Model {
  ChangeLog changes;
  std::vector<std::uint64_t> at;
  std::uint64_t count = 0;

  void reset(std::size_t objects) {
    changes.reset(objects);
    at.assign(objects, ++count);
  }
  void note(std::size_t object) {
    changes.note(object);
    at[object] = ++count;
  }
  std::vector<std::size_t> since(std::uint64_t then) const {
    std::vector<std::size_t> objects;
    for (std::size_t i = 0; i < at.size(); ++i) {
      if (at[i] > then) objects.push_back(i);
    }
    return objects;
  }
};

/// Over random sequences of changes, and of more and fewer objects.
TEST(ChangeLog, AreThoseSinceAnyMoment) {
  for (unsigned seed = 0; seed < 200; ++seed) {
    std::mt19937 random(seed);
    Model model;
    std::vector<std::pair<ChangeLog::Revision, std::uint64_t>> moments{{{}, 0}, {model.changes.now(), 0}};
    EXPECT_TRUE(model.changes.since({}).empty());
    for (int k = 0; k < 100; ++k) {
      if (k % 40 == 0) model.reset(random() % 30);
      for (unsigned n = random() % 4; n > 0 && !model.at.empty(); --n) model.note(random() % model.at.size());
      const auto& [moment, count] = moments[random() % moments.size()];
      EXPECT_EQ(model.changes.since(moment), model.since(count)) << "seed " << seed << ", " << k;
      EXPECT_EQ(model.changes.since(ChangeLog().now()), model.since(0)) << "of other objects, all";
      moments.emplace_back(model.changes.now(), model.count);
    }
  }
}

/// Of two that follow each other now and then.
TEST(ChangeLog, ThatDifferAreThoseHereAndThere) {
  for (unsigned seed = 0; seed < 200; ++seed) {
    std::mt19937 random(seed);
    const std::size_t objects = 1 + random() % 30;
    Model here, there;
    here.reset(objects);
    there.reset(objects);
    std::vector<bool> differs(objects, true);
    for (int k = 0; k < 200; ++k) {
      const std::size_t object = random() % objects;
      (random() % 2 == 0 ? here : there).note(object);
      differs[object] = true;
      std::vector<std::size_t> must;
      for (std::size_t i = 0; i < objects; ++i) {
        if (differs[i]) must.push_back(i);
      }
      EXPECT_EQ(here.changes.differing(there.changes), must) << "seed " << seed << ", " << k;
      if (random() % 5 != 0) continue;
      here.changes.mark_equal_to(there.changes);
      differs.assign(objects, false);
    }
  }
}

}  // namespace
}  // namespace spring_workbench::bodies::changes_test
