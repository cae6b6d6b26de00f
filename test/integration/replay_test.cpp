// `replay` as a user runs it: its arguments, its files, its exit status.
#include <gtest/gtest.h>
#include <rosbag/bag.h>
#include <sensor_msgs/Joy.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <tf2_msgs/TFMessage.h>
#include <yaml-cpp/yaml.h>

#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <limits>
#include <sstream>
#include <string>
#include <vector>

#include "spring_workbench/simulation/settings.h"
#include "support/temporary_folder.h"

namespace spring_workbench {
namespace {

const char* const kScene = R"(<robot name="one_box">
  <link name="workbench"/>
  <link name="box">
    <inertial><mass value="0.5"/><inertia ixx="4e-4" ixy="0" ixz="0" iyy="4e-4" iyz="0" izz="4e-4"/></inertial>
    <collision><geometry><box size="0.06 0.06 0.06"/></geometry></collision>
  </link>
  <joint name="box_joint" type="floating">
    <parent link="workbench"/><child link="box"/><origin xyz="0 0 0.03"/>
  </joint>
</robot>
)";

struct Sample {
  long milliseconds;
  double x, y, z, qx, qy, qz, qw;
  bool button;
};

/// The hand stands over the box, fork down, takes it, lifts it, puts it aside, lets go.
std::vector<Sample> lifting_hand() {
  std::vector<Sample> samples;
  for (long i = 0; i <= 100; ++i) {
    const double u = static_cast<double>(i) / 100.0;
    const double z = 0.24 + 0.1 * std::pow(std::sin(M_PI * u), 2);
    const double turn = 0.2 * u;
    samples.push_back({20 * i, 0.1 * u * u, 0.0, z, std::cos(turn), std::sin(turn), 0.0, 0.0, i > 10 && i < 90});
  }
  return samples;
}

std::string motion_text(const std::vector<Sample>& samples, double t_first = 0.0) {
  std::string text = "# t x y z qx qy qz qw button\n";
  for (const Sample& s : samples) {
    char line[300];
    std::snprintf(line, sizeof line, "%.3f %.17g %.17g %.17g %.17g %.17g %.17g %.17g %d\n",
                  t_first + 1e-3 * static_cast<double>(s.milliseconds), s.x, s.y, s.z, s.qx, s.qy, s.qz, s.qw,
                  s.button);
    text += line;
  }
  return text;
}

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

std::string content(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

struct Outcome {
  int status;
  std::string out, err;
};

class Replay : public testing::Test {
 protected:
  void SetUp() override {
    folder_.write("box.urdf", kScene);
    folder_.write("hand.tum", motion_text(lifting_hand()));
  }

  std::string path(const std::string& name) const { return folder_.path(name); }

  /// Runs `replay` in the test's folder; `arguments` as typed into a shell.
  Outcome run(const std::string& arguments) const {
    const std::string command = "cd '" + path(".") + "' && '" REPLAY_EXECUTABLE "' " + arguments + " >stdout 2>stderr";
    const int status = std::system(command.c_str());
    return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, content(path("stdout")), content(path("stderr"))};
  }

  YAML::Node summary_of(const Outcome& outcome) const {  // JSON is YAML
    std::istringstream lines(outcome.out);
    std::string last;
    for (std::string line; std::getline(lines, line);) last = line;
    return YAML::Load(last);
  }

  std::vector<std::vector<std::string>> table(const std::string& name) const {
    std::vector<std::vector<std::string>> rows;
    std::istringstream lines(content(path(name)));
    for (std::string line; std::getline(lines, line);) {
      rows.emplace_back();
      std::istringstream cells(line);
      for (std::string cell; std::getline(cells, cell, ',');) rows.back().push_back(cell);
    }
    return rows;
  }

  void expect_same_bytes(const std::string& a, const std::string& b) const {
    EXPECT_GT(content(path(a)).size(), 1000u);
    EXPECT_TRUE(content(path(a)) == content(path(b))) << a << " and " << b << " differ";
  }

  void expect_refused(const std::string& arguments, const std::vector<std::string>& words) const {
    const Outcome outcome = run(arguments);
    EXPECT_EQ(outcome.status, 2) << arguments;
    EXPECT_EQ(outcome.out, "") << arguments;
    EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
    EXPECT_EQ(outcome.err.rfind("replay: ", 0), 0u) << outcome.err;
    for (const std::string& word : words) {
      EXPECT_NE(outcome.err.find(word), std::string::npos) << "no '" << word << "' in: " << outcome.err;
    }
    for (const auto& entry : std::filesystem::directory_iterator(path("."))) {
      EXPECT_EQ(entry.path().filename().string().rfind("run.", 0), std::string::npos)
          << entry.path() << " left by " << arguments;
    }
  }

  test_support::TemporaryFolder folder_;
};

TEST_F(Replay, WritesALinePerOutputTimeAndObject) {
  const Outcome outcome = run("--scene box.urdf --motion hand.tum --set rate=25 --out run.csv");
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  const auto objects = table("run.csv");
  ASSERT_EQ(objects.size(), 52u);  // header, 0, 0.04, … 2 s
  EXPECT_EQ(content(path("run.csv")).substr(0, 44), "t,object,x,y,z,qx,qy,qz,qw,vx,vy,vz,wx,wy,wz");
  const auto fork = table("run.fork.csv");
  ASSERT_EQ(fork.size(), objects.size());
  EXPECT_EQ(fork[0][0] + fork[0][1], "tfork");
  for (std::size_t row = 1; row < objects.size(); ++row) {
    ASSERT_EQ(objects[row].size(), 15u);
    ASSERT_EQ(fork[row].size(), fork[0].size());
    EXPECT_EQ(std::stod(objects[row][0]), static_cast<double>(row - 1) / 25.0);
    EXPECT_EQ(objects[row][0], fork[row][0]);
    EXPECT_EQ(objects[row][1], "box");
    double norm = 0.0;
    for (std::size_t i = 2; i < 15; ++i) EXPECT_TRUE(std::isfinite(std::stod(objects[row][i])));
    for (std::size_t i = 5; i < 9; ++i) norm += std::pow(std::stod(objects[row][i]), 2);
    EXPECT_NEAR(norm, 1.0, 1e-12);
    for (std::size_t i = 4; i < fork[row].size(); ++i) EXPECT_TRUE(std::isfinite(std::stod(fork[row][i]))) << i;
  }
  const YAML::Node summary = summary_of(outcome);
  EXPECT_EQ(summary["outputs"].as<int>(), 51);
  EXPECT_EQ(summary["samples"].as<int>(), 101);
  EXPECT_EQ(summary["samples_rejected"].as<int>(), 0);
  EXPECT_GE(summary["steps"].as<int>(), 50);  // none while nothing moves
  EXPECT_NEAR(summary["simulated_time"].as<double>(), 2.0, 1e-9);
  for (const char* key : {"wall_time", "time_per_step", "position_error", "angle_error", "energy_drift", "contacts",
                          "collision_queries", "steps_rejected", "stiffest_omega_dt"}) {
    EXPECT_TRUE(std::isfinite(summary[key].as<double>())) << key;
  }
  EXPECT_TRUE(summary["active"].IsSequence() && summary["skipped"].IsSequence());
}

TEST_F(Replay, TheButtonTakesLiftsAndPutsDown) {
  ASSERT_EQ(run("--scene box.urdf --motion hand.tum --set contact=none --out run.csv").status, 0);
  const auto objects = table("run.csv");
  const auto fork = table("run.fork.csv");
  EXPECT_EQ(fork[5][3], "") << "not held before the button";
  EXPECT_EQ(fork[51][3], "box") << "held with the button down";
  EXPECT_EQ(fork[101][3], "") << "let go with the button";
  EXPECT_LT(std::abs(std::stod(objects[5][4]) - 0.03), 1e-6);
  EXPECT_GT(std::stod(objects[51][4]), 0.08) << "lifted";
}

TEST_F(Replay, SameInputSameBytes) {
  const std::string arguments = "--scene box.urdf --motion hand.tum --set step=0.003 ";
  ASSERT_EQ(run(arguments + "--out a.csv").status, 0);
  ASSERT_EQ(run(arguments + "--out b.csv").status, 0);
  expect_same_bytes("a.csv", "b.csv");
  expect_same_bytes("a.fork.csv", "b.fork.csv");
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
  expect_refused("--scene box.urdf --motion hand.tum --motion hand.tum --motion hand.tum --out run.csv",
                 {"--motion", "2 times"});
}

TEST_F(Replay, TheStartOfTimeMakesNoDifference) {
  folder_.write("later.tum", motion_text(lifting_hand(), 1500000000.0));
  ASSERT_EQ(run("--scene box.urdf --motion hand.tum --out a.csv").status, 0);
  ASSERT_EQ(run("--scene box.urdf --motion later.tum --out b.csv").status, 0);
  expect_same_bytes("a.csv", "b.csv");
}

TEST_F(Replay, SettingsFileAndCommandLineAreTheSameAndTheLatterWins) {
  folder_.write("settings.yaml", "rate: 10\nfork:\n  length: 0.25\n  stiffness: {bend: 90}\nstep: 0.004\n");
  folder_.write("other.yaml", "fork.length: 0.1\nrate: 10\n");
  ASSERT_EQ(run("--scene box.urdf --motion hand.tum --settings settings.yaml --out a.csv").status, 0);
  ASSERT_EQ(run("--scene box.urdf --motion hand.tum --settings other.yaml --set fork.length=0.25 --set step=0.004 "
                "--set fork.stiffness.bend=90 --out b.csv")
                .status,
            0);
  EXPECT_EQ(table("a.csv").size(), 22u);
  expect_same_bytes("a.fork.csv", "b.fork.csv");
}

TEST_F(Replay, RepeatedStampsAreLeftOutAndCounted) {
  auto samples = lifting_hand();
  samples.insert(samples.begin() + 50, 3, samples[49]);
  samples.push_back(samples[20]);
  folder_.write("repeats.tum", motion_text(samples));
  ASSERT_EQ(run("--scene box.urdf --motion hand.tum --out a.csv").status, 0);
  const Outcome outcome = run("--scene box.urdf --motion repeats.tum --out b.csv");
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_EQ(summary_of(outcome)["samples_rejected"].as<int>(), 4);
  EXPECT_EQ(table("a.csv").size(), table("b.csv").size());
}

TEST_F(Replay, APipeIsWrittenInPlace) {
  ASSERT_EQ(mkfifo(path("pipe.csv").c_str(), 0600), 0);
  ASSERT_EQ(run("--scene box.urdf --motion hand.tum --out a.csv").status, 0);
  const std::string command = "cd '" + path(".") +
                              "' && { cat pipe.csv >read.csv & '" REPLAY_EXECUTABLE
                              "' --scene box.urdf --motion hand.tum --out pipe.csv >stdout; wait; }";
  ASSERT_EQ(std::system(command.c_str()), 0);
  EXPECT_TRUE(std::filesystem::is_fifo(path("pipe.csv")));
  expect_same_bytes("a.csv", "read.csv");
}

TEST_F(Replay, HelpNamesEveryKey) {
  const Outcome outcome = run("--help");
  EXPECT_EQ(outcome.status, 0);
  EXPECT_EQ(outcome.err, "");
  for (const simulation::SettingDescription& d : simulation::setting_descriptions()) {
    EXPECT_NE(outcome.out.find("\n  " + d.key + " ("), std::string::npos) << d.key;
  }
  for (const char* option : {"--scene", "--motion", "--bag", "--settings", "--set", "--out", "rate"}) {
    EXPECT_NE(outcome.out.find(option), std::string::npos) << option;
  }
}

TEST_F(Replay, BadArgumentsAreRefusedWithOneLine) {
  struct Bad {
    std::string arguments;
    std::vector<std::string> words;
  };
  const std::string good = "--scene box.urdf --motion hand.tum --out run.csv ";
  const Bad table[] = {
      {"", {"--scene"}},
      {"--motion hand.tum --out run.csv", {"--scene"}},
      {"--scene box.urdf --out run.csv", {"--motion", "--bag"}},
      {"--scene box.urdf --motion hand.tum", {"--out"}},
      {good + "--bag hand.bag", {"--motion, --bag", "both"}},
      {good + "--scene box.urdf", {"--scene", "given once"}},
      {good + "--fast", {"--fast"}},
      {good + "--set", {"--set", "value"}},
      {good + "again", {"again"}},
      {good + "--set step", {"--set: step", "key=value"}},
      {good + "--set =3", {"--set: =3", "key=value"}},
      {good + "--set step=fast", {"command line: step: fast", "must be a finite number in [1e-06, 1]"}},
      {good + "--set step=nan", {"command line: step: nan", "must be"}},
      {good + "--set fork.stiffness.bend=-1", {"fork.stiffness.bend: -1", "must be"}},
      {good + "--set stepp=1", {"stepp: unknown key; known are", "fork.stiffness.bend"}},
      {good + "--set rate=0", {"rate: 0", "must be"}},
      {good + "--set integrator=euler", {"integrator: euler", "exponential"}},
      {good + "--set grasp.object=hat", {"grasp.object", "hat"}},
      {good + "--set 'grasp.tip_in_object=0 0 0 0 0 0 0'", {"grasp.tip_in_object", "0 0 0 0 0 0 0"}},
      {good + "--settings none.yaml", {"none.yaml"}},
      {"--scene none.urdf --motion hand.tum --out run.csv", {"none.urdf"}},
      {"--scene hand.tum --motion hand.tum --out run.csv", {"hand.tum"}},
      {"--scene box.urdf --motion none.tum --out run.csv", {"none.tum", "cannot be read"}},
      {"--scene box.urdf --bag none.bag --out run.csv", {"none.bag", "cannot be read"}},
      {"--scene box.urdf --bag hand.tum --out run.csv", {"hand.tum", "cannot be read"}},
      {"--scene box.urdf --motion hand.tum --out none/run.csv", {"none/run.csv", "cannot be written"}},
      {"--scene box.urdf --motion hand.tum --out .", {"cannot be written"}},
  };
  for (const Bad& bad : table) expect_refused(bad.arguments, bad.words);
}

TEST_F(Replay, BadFilesAreRefusedNamingTheirLine) {
  struct Bad {
    std::string file, text, arguments;
    std::vector<std::string> words;
  };
  const std::string motion = "--scene box.urdf --motion bad.tum --out run.csv";
  const std::string settings = "--scene box.urdf --motion hand.tum --settings bad.yaml --out run.csv";
  const Bad table[] = {
      {"bad.tum", "0 0 0 0 0 0 0 1\n1 0 0 oops 0 0 0 1\n", motion, {"bad.tum:2: z: oops", "must be"}},
      {"bad.tum", "0 0 0 0 0 0 0 1\n1 0 0 nan 0 0 0 1\n", motion, {"bad.tum:2: z: nan", "must be"}},
      {"bad.tum", "0 0 0 0 0 0 0 0\n", motion, {"bad.tum:1: norm of qx qy qz qw: 0"}},
      {"bad.tum", "", motion, {"bad.tum", "no samples"}},
      {"bad.yaml", "step: 0.01\nfork:\n  stiffness: {bend: -3}\n", settings, {"bad.yaml:3: fork.stiffness.bend: -3"}},
      {"bad.yaml", "step: 0.01\nspeed: 3\n", settings, {"bad.yaml:2: speed: unknown key"}},
      {"bad.yaml", "\nrate: .nan\n", settings, {"bad.yaml:2: rate: .nan"}},
      {"bad.yaml", "- step\n", settings, {"bad.yaml", "a map"}},
      {"bad.yaml", "step: [0.01\n", settings, {"bad.yaml:", "not YAML"}},
  };
  for (const Bad& bad : table) {
    folder_.write(bad.file, bad.text);
    expect_refused(bad.arguments, bad.words);
  }
}

TEST_F(Replay, BadBagsAreRefused) {
  auto samples = lifting_hand();
  write_bag(path("frames.bag"), samples, {"odom", "base_link"});
  expect_refused("--scene box.urdf --bag frames.bag --out run.csv",
                 {"frames.bag: transform: workbench -> stylus", "odom -> base_link"});
  samples[3].qx = samples[3].qy = samples[3].qz = samples[3].qw = 0.0;
  write_bag(path("zero.bag"), samples);
  expect_refused("--scene box.urdf --bag zero.bag --out run.csv",
                 {"zero.bag: workbench -> stylus at 1500000000.183456789", "norm of rotation: 0"});
  samples = lifting_hand();
  samples[4].x = std::nan("");
  write_bag(path("nan.bag"), samples);
  expect_refused("--scene box.urdf --bag nan.bag --out run.csv", {"nan.bag", "translation.x: nan"});
  std::filesystem::resize_file(path("frames.bag"), 5000);
  expect_refused("--scene box.urdf --bag frames.bag --out run.csv", {"frames.bag"});
  rosbag::Bag(path("empty.bag"), rosbag::bagmode::Write).close();
  expect_refused("--scene box.urdf --bag empty.bag --out run.csv", {"empty.bag", "none"});
}

/// Bags of other people: lz4, the old tf/tfMessage.
TEST_F(Replay, ReadsBagsFromElsewhere) {
  const std::string bags = std::string(SPRING_WORKBENCH_SHARED_DIR) + "/data/bags/";
  if (!std::ifstream(bags + "rosbagjs_turtlesim_tf.bag")) GTEST_SKIP() << "no bags in " << bags;
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

/// Every recorded hand holds the box from first to last without anything that is not finite. Under a sanitizer the
/// first 500 lines of each: refused steps, a few there and 1,287 in all of a hand that leaps (falcon5), take more than
/// eleven minutes with it.
TEST_F(Replay, RecordedMotionsRun) {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
  constexpr int most_lines = 500, least_outputs = 100;
#else
  constexpr int most_lines = std::numeric_limits<int>::max(), least_outputs = 1000;
#endif
  const std::string motions = std::string(SPRING_WORKBENCH_SHARED_DIR) + "/data/motions/";
  if (!std::filesystem::exists(motions)) GTEST_SKIP() << "no motions in " << motions;
  for (const auto& entry : std::filesystem::directory_iterator(motions)) {
    if (entry.path().extension() != ".tum") continue;
    SCOPED_TRACE(entry.path().filename());
    std::ifstream recorded(entry.path());
    std::string motion;
    int lines = 0;
    for (std::string line; lines < most_lines && std::getline(recorded, line); ++lines) motion += line + "\n";
    folder_.write("recorded.tum", motion);
    const Outcome outcome =
        run("--scene box.urdf --motion recorded.tum --set grasp.object=box --set start.follow=true "
            "--set contact=none --out run.csv");
    ASSERT_EQ(outcome.status, 0) << outcome.err;
    const std::string objects = content(path("run.csv"));
    EXPECT_EQ(objects.find("nan"), std::string::npos);
    EXPECT_EQ(objects.find("inf"), std::string::npos);
    EXPECT_EQ(outcome.out.find("nan"), std::string::npos) << outcome.out;
    EXPECT_EQ(outcome.out.find("inf"), std::string::npos) << outcome.out;
    EXPECT_GT(summary_of(outcome)["outputs"].as<int>(), least_outputs);
  }
}

}  // namespace
}  // namespace spring_workbench
