// `replay` from bags.
#include <rosbag/bag.h>
#include <rosbag/view.h>
#include <sensor_msgs/Joy.h>
#include <tf2_msgs/TFMessage.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <string>
#include <utility>
#include <vector>

#include "integration/replay_fixture.h"
#include "spring_workbench/Change.h"
#include "spring_workbench/scene/scene.h"
#include "spring_workbench/simulation/simulation.h"

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
                 {"frames.bag: transform: invalid value 'workbench -> stylus': expected one of odom -> base_link "
                  "(choose with --parent and --child)"});
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

tf2_msgs::TFMessage link(const std::string& parent, const std::string& child, double x) {
  tf2_msgs::TFMessage tf;
  tf.transforms.emplace_back();
  tf.transforms[0].header.frame_id = parent;
  tf.transforms[0].child_frame_id = child;
  tf.transforms[0].transform.translation.x = x;
  tf.transforms[0].transform.rotation.w = 1.0;
  return tf;
}

/// As in the node: the workbench stands in the world, and the tracker on the workbench.
TEST_F(Replay, StaticTransformsPlaceTheHandInTheWorld) {
  const auto static_frames = [&](const std::string& bag_path) {  // after the first poses, as a recorder may get them
    rosbag::Bag bag(bag_path, rosbag::bagmode::Append);
    bag.write("/tf_static", ros::Time(1500000001), link("world", "workbench", 0.25));
    bag.write("/tf_static", ros::Time(1500000001), link("/workbench", "/tracker", -0.125));
  };
  write_bag(path("plain.bag"), lifting_hand());
  write_bag(path("hand.bag"), lifting_hand());
  static_frames(path("hand.bag"));
  write_bag(path("tracker.bag"), lifting_hand(), {"tracker", "stylus"});
  static_frames(path("tracker.bag"));
  ASSERT_EQ(run("--scene box.urdf --bag plain.bag --out plain.csv").status, 0);
  ASSERT_EQ(run("--scene box.urdf --bag hand.bag --out hand.csv").status, 0);
  ASSERT_EQ(run("--scene box.urdf --bag tracker.bag --out tracker.csv").status, 0);
  const auto plain = table("plain.fork.csv"), hand = table("hand.fork.csv"), tracker = table("tracker.fork.csv");
  const auto x = static_cast<std::size_t>(std::find(plain[0].begin(), plain[0].end(), "handle_x") - plain[0].begin());
  ASSERT_EQ(plain.size(), hand.size());
  ASSERT_EQ(plain.size(), tracker.size());
  for (std::size_t row = 1; row < plain.size(); ++row) {
    EXPECT_NEAR(std::stod(hand[row][x]) - std::stod(plain[row][x]), 0.25, 1e-9);
    EXPECT_NEAR(std::stod(tracker[row][x]) - std::stod(plain[row][x]), 0.125, 1e-9);
  }
}

/// The journal of a live run in which nothing happened, with the hand that the node did not see.
void add_journal(const std::string& bag_path, const std::string& scene) {
  simulation::Simulation simulation(scene::load_scene(scene), {});
  const RigidTransform above = make_transform(Vector3d(0.0, 0.0, 0.24), Quaterniond(0, 1, 0, 0));
  for (const double t : {0.0, 0.1}) simulation.push_stylus({t, above});
  simulation.advance_to(0.1);
  rosbag::Bag bag(bag_path, rosbag::bagmode::Append);
  const auto write = [&](std::uint64_t index, const std::string& state) {
    Change change;
    change.index = index;
    change.committed = simulation.time();
    change.what = "test";
    change.scene = scene;
    change.hash_before = math::to_hex(simulation.state_hash());
    change.state = state;
    bag.write("/manipulation/changes", ros::Time(1500000001), change);
  };
  write(0, simulation::serialise(simulation.save()));
  write(1, "");
}

TEST_F(Replay, AJournalIsRepeatedAsRecordedAndItsHandAloneAsSet) {
  write_bag(path("hand.bag"), lifting_hand());
  write_bag(path("live.bag"), lifting_hand());
  add_journal(path("live.bag"), path("box.urdf"));
  const Outcome repeated = run("--scene box.urdf --bag live.bag --set gravity=9.81 --out a.csv");
  ASSERT_EQ(repeated.status, 0) << repeated.err;
  EXPECT_EQ(summary_of(repeated)["samples"].as<int>(), 0);
  folder_.write("fork.yaml", "contact: none\nfork:\n  stiffness: {bend: 300}\n");
  const std::pair<std::string, std::string> options[] = {
      {"--set integrator=rk4",
       "command line: integrator: cannot be given for live.bag, whose ~accepted and ~changes are "
       "repeated as recorded; add --hand-only"},
      {"--set rate=10", "command line: rate: cannot be given for live.bag"},
      {"--set input.max_speed=1", "command line: input.max_speed: cannot be given for live.bag"},
      {"--settings fork.yaml", "fork.yaml:3: fork.stiffness.bend: cannot be given for live.bag"},
      {"--parent workbench", "command line: --parent: cannot be given for live.bag"},
      {"--child stylus", "command line: --child: cannot be given for live.bag"}};
  for (const auto& [option, message] : options) {
    expect_refused("--scene box.urdf --bag live.bag --out run.csv " + option, {message});
    ASSERT_EQ(run("--scene box.urdf --bag live.bag --hand-only --out b.csv " + option).status, 0) << option;
    ASSERT_EQ(run("--scene box.urdf --bag hand.bag --out c.csv " + option).status, 0) << option;
    expect_same_bytes("b.csv", "c.csv");
    expect_same_bytes("b.fork.csv", "c.fork.csv");
  }
  expect_refused("--scene box.urdf --motion hand.tum --hand-only --out run.csv",
                 {"command line: --hand-only: can only be given together with --bag"});
}

TEST_F(Replay, QuaternionsInABagAreHeldToTheirTolerance) {
  auto samples = lifting_hand();
  for (Sample& s : samples) s.qx *= 0.8, s.qy *= 0.8;
  write_bag(path("hand.bag"), samples);
  const Outcome outcome = run("--scene box.urdf --bag hand.bag --out run.csv");
  EXPECT_EQ(summary_of(outcome)["rejected"]["not a unit quaternion"].as<int>(), 101);
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
