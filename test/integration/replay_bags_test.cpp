// `replay` from bags.
#include <rosbag/bag.h>
#include <rosbag/view.h>
#include <sensor_msgs/Joy.h>
#include <tf2_msgs/TFMessage.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "integration/replay_fixture.h"

namespace spring_workbench {
namespace {

struct BagFrames {
  std::string parent = "workbench";
  std::string child = "stylus";
  std::string joy = "/stylus/joy";
};

void write_bag(const std::string& path, const std::vector<Sample>& samples, const BagFrames& frames = {},
               rosbag::bagmode::BagMode mode = rosbag::bagmode::Write) {
  rosbag::Bag bag(path, mode);
  const ros::Time first(1500000000, 123456789);
  for (const Sample& s : samples) {
    const ros::Time stamp = first + ros::Duration().fromNSec(static_cast<int64_t>(s.milliseconds) * 1000000);
    sensor_msgs::Joy joy;
    joy.header.stamp = stamp;
    joy.buttons = {s.button ? 1 : 0, 0};
    bag.write(frames.joy, stamp, joy);
    geometry_msgs::TransformStamped transform;
    transform.header.stamp = stamp;
    transform.header.frame_id = frames.parent;
    transform.child_frame_id = frames.child;
    transform.transform.translation.x = s.x;
    transform.transform.translation.y = s.y;
    transform.transform.translation.z = s.z;
    transform.transform.rotation.x = s.qx;
    transform.transform.rotation.y = s.qy;
    transform.transform.rotation.z = s.qz;
    transform.transform.rotation.w = s.qw;
    tf2_msgs::TFMessage tf;
    tf.transforms = {transform};
    bag.write("/tf", stamp, tf);
  }
}

TEST_F(Replay, ABagGivesTheSameBytesAsTheMotionFile) {
  write_bag(path("hand.bag"), lifting_hand());
  write_bag(path("slashes.bag"), lifting_hand(), {"/base", "/pen"});
  ASSERT_EQ(run("--scene box.urdf --motion hand.tum --out a.csv").status, 0);
  ASSERT_EQ(run("--scene box.urdf --bag hand.bag --out b.csv").status, 0);
  ASSERT_EQ(run("--scene box.urdf --bag slashes.bag --parent base --child pen --out c.csv").status, 0);
  for (const std::string name : {"b", "c"}) {
    expect_same_bytes("a.csv", name + ".csv");
    expect_same_bytes("a.fork.csv", name + ".fork.csv");
  }
}

TEST_F(Replay, ABagOfTwoHandsGivesTheSameBytesAsTheirMotionFiles) {
  std::vector<Sample> second = lifting_hand();
  for (Sample& s : second) s.x += 0.02;
  folder_.write("second.tum", motion_text(second));
  write_bag(path("hands.bag"), lifting_hand());
  write_bag(path("hands.bag"), second, {"workbench", "stylus_2", "stylus_2/joy"}, rosbag::bagmode::Append);
  ASSERT_EQ(run("--scene box.urdf --motion hand.tum --motion second.tum --out a.csv").status, 0);
  ASSERT_EQ(run("--scene box.urdf --bag hands.bag --out b.csv").status, 0);
  expect_same_bytes("a.csv", "b.csv");
  expect_same_bytes("a.fork.csv", "b.fork.csv");
  const auto fork = table("a.fork.csv");
  ASSERT_EQ(fork.size(), 2 * (table("a.csv").size() - 1) + 1);
  int both_hold = 0;
  for (std::size_t row = 1; row < fork.size(); row += 2) {
    EXPECT_EQ(fork[row][1] + fork[row + 1][1], "forkfork_2");
    EXPECT_EQ(fork[row][0], fork[row + 1][0]);
    both_hold += fork[row][3] == "box" && fork[row + 1][3] == "box" ? 1 : 0;
  }
  EXPECT_GT(both_hold, 50);
}

/// Hands with any numbers: the fourth of four has its own rows, and the third, which is not in the bag, has none.
TEST_F(Replay, ABagOfManyHandsIsReplayedWithAllOfThem) {
  const std::string numbers[] = {"", "_2", "_4"};
  std::string motions;
  for (std::size_t k = 0; k < 3; ++k) {
    std::vector<Sample> samples = lifting_hand();
    for (Sample& s : samples) s.x += 0.02 * (static_cast<double>(k) - 1.0);
    folder_.write("hand" + numbers[k] + ".tum", motion_text(samples));
    write_bag(path("hands.bag"), samples, {"workbench", "stylus" + numbers[k], "stylus" + numbers[k] + "/joy"},
              k == 0 ? rosbag::bagmode::Write : rosbag::bagmode::Append);
    motions += " --motion hand" + numbers[k] + ".tum";
  }
  ASSERT_EQ(run("--scene box.urdf" + motions + " --out a.csv").status, 0);
  ASSERT_EQ(run("--scene box.urdf --bag hands.bag --out b.csv").status, 0);
  expect_same_bytes("a.csv", "b.csv");
  const auto a = table("a.fork.csv"), b = table("b.fork.csv");
  ASSERT_EQ(b.size(), 3 * (table("b.csv").size() - 1) + 1);
  ASSERT_EQ(a.size(), b.size());
  int all_hold = 0;
  for (std::size_t row = 1; row < b.size(); row += 3) {
    EXPECT_EQ(b[row][1] + b[row + 1][1] + b[row + 2][1], "forkfork_2fork_4");
    EXPECT_EQ(a[row + 2][1], "fork_3");
    for (std::size_t i = 4; i < b[row].size(); ++i) EXPECT_EQ(a[row + 2][i], b[row + 2][i]);
    all_hold += b[row][3] == "box" && b[row + 1][3] == "box" && b[row + 2][3] == "box" ? 1 : 0;
  }
  EXPECT_GT(all_hold, 50);
  write_bag(path("far.bag"), lifting_hand(), {"workbench", "stylus_300", "stylus_300/joy"});
  expect_refused("--scene box.urdf --bag far.bag --out run.csv",
                 {"styluses: invalid value '300': expected an integer between 1 and 255"});
}

TEST_F(Replay, BadBagsAreRefused) {
  auto samples = lifting_hand();
  write_bag(path("frames.bag"), samples, {"odom", "base_link"});
  expect_refused("--scene box.urdf --bag frames.bag --out run.csv",
                 {"frames.bag: transform: invalid value 'workbench -> stylus': expected one in the bag, which has odom "
                  "-> base_link"});
  samples[3].qx = samples[3].qy = samples[3].qz = samples[3].qw = 0.0;
  write_bag(path("zero.bag"), samples);
  expect_refused("--scene box.urdf --bag zero.bag --out run.csv",
                 {"zero.bag: workbench -> stylus at 1500000000.183456789",
                  "norm of rotation: invalid value '0': expected a number between 0.5 and 2"});
  samples = lifting_hand();
  samples[4].x = std::nan("");
  write_bag(path("nan.bag"), samples);
  expect_refused("--scene box.urdf --bag nan.bag --out run.csv",
                 {"nan.bag", "translation.x: invalid value 'nan': expected"});
  std::filesystem::resize_file(path("frames.bag"), 5000);
  expect_refused("--scene box.urdf --bag frames.bag --out run.csv", {"frames.bag"});
  rosbag::Bag(path("empty.bag"), rosbag::bagmode::Write).close();
  expect_refused("--scene box.urdf --bag empty.bag --out run.csv", {"empty.bag", "none"});
  expect_refused("--scene box.urdf --bag none.bag --out run.csv", {"none.bag", "cannot be read"});
  expect_refused("--scene box.urdf --bag hand.tum --out run.csv", {"hand.tum", "cannot be read"});
}

TEST_F(Replay, CompressedBagsAndTheOldTfMessageGiveTheSameBytes) {
  write_bag(path("hand.bag"), lifting_hand());
  const auto copy = [&](const std::string& name, rosbag::compression::CompressionType compression) {
    const rosbag::Bag from(path("hand.bag"));
    rosbag::Bag to(path(name), rosbag::bagmode::Write);
    to.setCompression(compression);
    rosbag::View messages(from);
    for (const rosbag::MessageInstance& message : messages) {
      const auto header = boost::make_shared<ros::M_string>(*message.getConnectionHeader());
      if (message.getTopic() == "/tf") (*header)["type"] = "tf/tfMessage";  // the type before tf2, with the same bytes
      to.write(message.getTopic(), message.getTime(), message, header);
    }
  };
  copy("lz4.bag", rosbag::compression::LZ4);
  copy("bz2.bag", rosbag::compression::BZ2);
  ASSERT_EQ(run("--scene box.urdf --bag hand.bag --out a.csv").status, 0);
  for (const std::string name : {"lz4", "bz2"}) {
    ASSERT_EQ(run("--scene box.urdf --bag " + name + ".bag --out b.csv").status, 0);
    expect_same_bytes("a.csv", "b.csv");
  }
}

/// Third-party bags: lz4, the old tf/tfMessage.
TEST_F(Replay, ReadsBagsFromElsewhere) {
  const std::string bags = test_support::extra_data("data/bags/");
  if (bags.empty()) GTEST_SKIP() << "SPRING_WORKBENCH_TEST_DATA is not given";
  const Outcome old_tf =
      run("--scene box.urdf --bag '" + bags + "rosbagjs_turtlesim_tf.bag' --parent world --child turtle1 --out a.csv");
  ASSERT_EQ(old_tf.status, 0) << old_tf.err;
  EXPECT_GT(table("a.csv").size(), 1000u);
  const Outcome lz4 = run("--scene box.urdf --bag '" + bags +
                          "evo_tf_example_lz4.bag' --parent odom --child base_footprint --out b.csv");
  ASSERT_EQ(lz4.status, 0) << lz4.err;
  EXPECT_EQ(summary_of(lz4)["samples"].as<int>(), 517);
  expect_refused("--scene box.urdf --bag '" + bags + "rosbagjs_not-a-bag.bag' --out run.csv", {"not-a-bag.bag"});
  expect_refused("--scene box.urdf --bag '" + bags + "rosbagjs_no-messages.bag' --out run.csv", {"no-messages.bag"});
}

}  // namespace
}  // namespace spring_workbench
