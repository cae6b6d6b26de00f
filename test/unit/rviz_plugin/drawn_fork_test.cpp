#include "src/rviz_plugin/drawn_fork.h"

#include <gtest/gtest.h>

#include <limits>
#include <string>

#include "ogre.h"
#include "spring_workbench/validation/input_error.h"

namespace spring_workbench::rviz_plugin::drawn_fork_test {
namespace {

const std::string tools[] = {"spring_fork", "spring", "spring_probe", "direct", "ray"};

ForkState fork_of(const std::string& tool, double bend) {
  ForkState fork;
  fork.tool = tool;
  fork.shape = "constant";
  fork.length = 0.2;
  fork.diameter = 0.03;
  fork.strain = {bend, 0.0, 0.0, 0.0};
  fork.load = 0.5;
  fork.proxy_handle.orientation.w = 1.0;
  return fork;
}

class DrawnForkTest : public Ogre3d {
 protected:
  /// What there is of ManualObject, the class of forks.
  std::size_t objects() { return manager_->getMovableObjects("ManualObject").size(); }
};

TEST_F(DrawnForkTest, EverythingIsFreed) {
  const Counts before = counts();
  const std::size_t objects_before = objects();
  for (int i = 0; i < 20; ++i) {
    DrawnFork fork(manager_, parent_);
    EXPECT_EQ(objects(), objects_before + 1);
    EXPECT_EQ(parent_->numAttachedObjects(), 1u);
    for (const std::string& tool : tools) fork.draw(fork_of(tool, 0.5));
  }
  EXPECT_EQ(counts(), before);
  EXPECT_EQ(objects(), objects_before);
  EXPECT_EQ(parent_->numAttachedObjects(), 0u);
}

TEST_F(DrawnForkTest, FramesAndOtherToolsMakeNothingNew) {
  DrawnFork fork(manager_, parent_);
  fork.draw(fork_of(tools[0], 0.0));
  const Counts with = counts();
  for (int i = 0; i < 100; ++i) {
    for (const std::string& tool : tools) fork.draw(fork_of(tool, 0.01 * i));
    EXPECT_THROW(fork.draw(fork_of(tools[0], std::numeric_limits<double>::quiet_NaN())), validation::InputError);
    fork.hide();
    EXPECT_FALSE(fork.visible());
  }
  EXPECT_EQ(counts(), with);
  EXPECT_EQ(objects(), 1u);
}

}  // namespace
}  // namespace spring_workbench::rviz_plugin::drawn_fork_test
