#include "integration/replay_fixture.h"

namespace spring_workbench {
namespace {

TEST_F(Replay, ABuildWithoutRosRefusesBags) {
  expect_refused("--scene box.urdf --bag hand.bag --out run.csv",
                 {"--bag: this replay was built without ROS and cannot read bags; use --motion"});
}

}  // namespace
}  // namespace spring_workbench
