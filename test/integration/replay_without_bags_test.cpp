#include "integration/replay_fixture.h"

namespace spring_workbench {
namespace {

TEST_F(Replay, ABuildWithoutRosRefusesBags) {
  expect_refused("--scene box.urdf --bag hand.bag --out run.csv",
                 {"--bag: must be given to a build with ROS", "hand.bag"});
}

}  // namespace
}  // namespace spring_workbench
