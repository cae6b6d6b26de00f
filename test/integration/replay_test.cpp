// `replay` as run by a user: arguments, files, exit status.
#include <sys/stat.h>

#include <cmath>
#include <limits>
#include <regex>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "integration/replay_fixture.h"
#include "spring_workbench/simulation/settings.h"

namespace spring_workbench {
namespace {

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
    for (std::size_t i = 4; i < fork[row].size(); ++i) {
      const std::set<std::string> may_be_unknown{"weight_uncertainty", "torque_uncertainty", "error_bound"};  // inf
      const double value = std::stod(fork[row][i]);
      EXPECT_TRUE(std::isfinite(value) || (may_be_unknown.count(fork[0][i]) > 0 && value > 0.0)) << fork[0][i];
    }
  }
  const YAML::Node summary = summary_of(outcome);
  EXPECT_EQ(summary["outputs"].as<int>(), 51);
  EXPECT_EQ(summary["samples"].as<int>(), 101);
  EXPECT_EQ(summary["samples_rejected"].as<int>(), 0);
  EXPECT_GE(summary["steps"].as<int>(), 50);  // no steps while nothing moves
  EXPECT_NEAR(summary["simulated_time"].as<double>(), 2.0, 1e-9);
  for (const char* key : {"wall_time", "time_per_step", "position_error", "angle_error", "energy_balance", "contacts",
                          "collision_queries", "steps_rejected", "stiffest_omega_dt"}) {
    EXPECT_TRUE(std::isfinite(summary[key].as<double>())) << key;
  }
  EXPECT_TRUE(summary["active"].IsSequence() && summary["skipped"].IsSequence());
  std::string help = run("--help").out;
  help.erase(0, help.find("JSON"));
  for (const auto& entry : summary) {
    const std::regex row("\n  (\\w+, )*" + entry.first.as<std::string>() + "[, ]");
    EXPECT_TRUE(std::regex_search(help, row)) << "--help does not explain " << entry.first;
  }
}

TEST_F(Replay, QuaternionsInAMotionFileAreHeldToTheirTolerance) {
  auto samples = lifting_hand();
  samples[50].qx *= 0.95, samples[50].qy *= 0.95;
  folder_.write("hand.tum", motion_text(samples));
  const std::pair<const char*, int> rejected[] = {{"0.1", 0}, {"0.01", 1}};
  for (const auto& [tolerance, count] : rejected) {
    const Outcome outcome =
        run("--scene box.urdf --motion hand.tum --set input.quaternion_tolerance=" + std::string(tolerance) +
            " --out run.csv");
    EXPECT_EQ(summary_of(outcome)["samples_rejected"].as<int>(), count) << outcome.err;
  }
}

TEST_F(Replay, AHandWithSlowSamplesIsToldWhyItDoesNotMove) {
  auto samples = lifting_hand();
  for (std::size_t i = 0; i < samples.size(); ++i) samples[i].milliseconds = 600 * static_cast<long>(i);
  folder_.write("hand.tum", motion_text(samples));
  const Outcome slow = run("--scene box.urdf --motion hand.tum --out run.csv");
  EXPECT_EQ(slow.status, 0);
  EXPECT_EQ(slow.err,
            "warning: hand 1: samples come 0.6 s apart, more than dropout_after = 0.5 s: each gap counts as a "
            "dropout, so the hand does not move; increase dropout_after\n");
  const Outcome moves = run("--scene box.urdf --motion hand.tum --set dropout_after=1 --out run.csv");
  EXPECT_EQ(moves.err, "");
  EXPECT_EQ(summary_of(moves)["dropouts"].as<int>(), 0);
}

TEST_F(Replay, WarnsWhenTheIntegratorDidNotTakeTheSteps) {
  folder_.write("hand.tum", motion_text(lifting_hand()));
  const std::string command = "--scene box.urdf --motion hand.tum --out run.csv --set integrator=";
  const Outcome unstable = run(command + "rk4 --set step=0.02");
  const YAML::Node summary = summary_of(unstable);
  EXPECT_GT(summary["steps_fallback"].as<int>(), summary["steps"].as<int>() / 100);
  EXPECT_EQ(unstable.err, "warning: the integrator failed in " + summary["steps_fallback"].as<std::string>() +
                              " integrations, which the fallback rule then took: decrease step or choose another "
                              "integrator\n");
  EXPECT_EQ(run(command + "exponential --set step=0.02").err, "");
}

TEST_F(Replay, RefusesToReplaceWhatItReads) {
  folder_.write("hand.tum", motion_text(lifting_hand()));
  folder_.write("a.fork.csv", motion_text(lifting_hand()));
  folder_.write("settings.yaml", "step: 0.02\n");
  const std::pair<const char*, const char*> bad[] = {
      {"--motion hand.tum --out ./box.urdf", "./box.urdf"},
      {"--motion hand.tum --out hand.tum", "hand.tum"},
      {"--motion hand.tum --settings settings.yaml --out settings.yaml", "settings.yaml"},
      {"--motion a.fork.csv --out a.csv", "a.csv"}};
  const std::string scene = content(path("box.urdf"));
  for (const auto& [arguments, out] : bad) {
    expect_refused("--scene box.urdf " + std::string(arguments),
                   {"command line: --out: ", " is an input of this run and would be overwritten"});
  }
  EXPECT_EQ(content(path("box.urdf")), scene);
}

TEST_F(Replay, WarnsOfAHandInMillimetresAndOfOneThatHoldsNothing) {
  auto samples = lifting_hand();
  for (Sample& s : samples) s.x *= 1000.0, s.y *= 1000.0, s.z *= 1000.0;
  folder_.write("hand.tum", motion_text(samples));
  const Outcome outcome = run("--scene box.urdf --motion hand.tum --out run.csv");
  EXPECT_NE(outcome.err.find(" samples were rejected: are positions in metres"), std::string::npos) << outcome.err;
  EXPECT_NE(outcome.err.find("warning: no object was held or probed: "), std::string::npos) << outcome.err;
}

TEST_F(Replay, StampsInAnotherUnitAreRefused) {
  auto samples = lifting_hand();
  for (Sample& s : samples) s.milliseconds *= 1000000;  // nanoseconds, taken for seconds
  folder_.write("hand.tum", motion_text(samples));
  expect_refused(
      "--scene box.urdf --motion hand.tum --out run.csv",
      {"hand.tum: time of the last sample: invalid value '2000000': expected at most 200000 s after the first "
       "(1e7 output times at rate = 50 Hz)"});
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

TEST_F(Replay, RepeatedStampsAreRejectedAndCounted) {
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
  const std::string command = "cd '" + path(".") + "' && { cat pipe.csv >read.csv & '" +
                              test_support::program("replay") +
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
    const std::string unit = d.unit == "–" ? ": " : " [";
    EXPECT_NE(outcome.out.find("\n  " + d.key + unit), std::string::npos) << d.key;
  }
  EXPECT_LT(outcome.out.find("Example"), outcome.out.find("Keys"));
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
      {"", {"missing required option --scene: path of a URDF scene"}},
      {"--motion hand.tum --out run.csv", {"missing required option --scene: "}},
      {"--scene box.urdf --out run.csv", {"missing required option --motion or --bag: "}},
      {"--scene box.urdf --motion hand.tum", {"missing required option --out: "}},
      {good + "--bag hand.bag", {"--motion, --bag", "cannot be given together"}},
      {good + "--scene box.urdf", {"--scene", "given twice"}},
      {good + "--fast", {"--fast"}},
      {good + "--set", {"command line: --set: expected a value"}},
      {good + "again", {"again"}},
      {good + "--set step", {"--set: invalid value 'step': expected key=value"}},
      {good + "--set =3", {"--set: invalid value '=3': expected key=value"}},
      {good + "--set step=fast", {"command line: step: invalid value 'fast': expected a number between 1e-6 and 1 s"}},
      {good + "--set step=nan", {"command line: step: invalid value 'nan': expected"}},
      {good + "--set fork.stiffness.bend=-1", {"fork.stiffness.bend: invalid value '-1': expected"}},
      {good + "--set stepp=1", {"stepp: unknown key; did you mean step?"}},
      {good + "--set rate=0", {"rate: invalid value '0': expected"}},
      {good + "--set integrator=euler", {"integrator: invalid value 'euler': expected one of exponential"}},
      {good + "--set grasp.object=hat", {"command line: grasp.object: invalid value 'hat': expected a movable object"}},
      {good + "--set start.follow=true", {"start.follow: needs grasp.object, the object to move"}},
      {good + "--set start.follow=true --set 'grasp.tip_in_object=0 0 0 0 0 0 1'",
       {"start.follow: needs grasp.object"}},
      {good + "--set 'grasp.tip_in_object=0 0 0 0 0 0 0'", {"grasp.tip_in_object", "0 0 0 0 0 0 0"}},
      {good + "--settings none.yaml", {"none.yaml"}},
      {"--scene none.urdf --motion hand.tum --out run.csv", {"none.urdf"}},
      {"--scene hand.tum --motion hand.tum --out run.csv", {"hand.tum"}},
      {"--scene box.urdf --motion none.tum --out run.csv",
       {"none.tum: expected a readable motion file (No such file or directory)"}},
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
      {"bad.tum", "0 0 0 0 0 0 0 1\n1 0 0 oops 0 0 0 1\n", motion, {"bad.tum:2: z: invalid value 'oops': expected"}},
      {"bad.tum", "0 0 0 0 0 0 0 1\n1 0 0 nan 0 0 0 1\n", motion, {"bad.tum:2: z: invalid value 'nan': expected"}},
      {"bad.tum", "0 0 0 0 0 0 0 0\n", motion, {"bad.tum:1: norm of qx qy qz qw: invalid value '0': expected"}},
      {"bad.tum", "", motion, {"bad.tum: expected lines of t x y z", "got none"}},
      {"bad.yaml",
       "step: 0.01\nfork:\n  stiffness: {bend: -3}\n",
       settings,
       {"bad.yaml:3: fork.stiffness.bend: invalid value '-3': expected"}},
      {"bad.yaml", "step: 0.01\nspeed: 3\n", settings, {"bad.yaml:2: speed: unknown key"}},
      {"bad.yaml", "\nrate: .nan\n", settings, {"bad.yaml:2: rate: invalid value '.nan': expected"}},
      {"bad.yaml", "- step\n", settings, {"bad.yaml:1: top level: expected a map"}},
      {"bad.yaml", "\ninput: {max_sped: 3}\n", settings, {"bad.yaml:2: input.max_sped: unknown key"}},
      {"bad.yaml", "\ninput.max_sped: 3\n", settings, {"bad.yaml:2: input.max_sped: unknown key"}},
      {"bad.yaml", "\ninput: 3\n", settings, {"bad.yaml:2: input: invalid value '3': expected a map"}},
      {"bad.yaml", "\ngrasp:\n  object: hat\n", settings, {"bad.yaml:3: grasp.object: invalid value 'hat'"}},
      {"bad.yaml",
       "\ngrasp.tip_in_object: 0 0 0 0 0 0 1\n",
       settings,
       {"bad.yaml:2: grasp.tip_in_object: needs start.follow: true"}},
      {"bad.yaml", "step: [0.01\n", settings, {"bad.yaml:", "not YAML"}},
  };
  for (const Bad& bad : table) {
    folder_.write(bad.file, bad.text);
    expect_refused(bad.arguments, bad.words);
  }
}

/// The hands in a folder hold the box to the end with finite results. Under a sanitizer, only the first 500 lines of
/// each.
class FoldersOfMotions : public Replay {
 protected:
  void expect_finite(const std::string& folder, int min_outputs) {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
    constexpr int max_lines = 500;
    min_outputs = std::min(min_outputs, 100);
#else
    constexpr int max_lines = std::numeric_limits<int>::max();
#endif
    for (const auto& entry : std::filesystem::directory_iterator(folder)) {
      if (entry.path().extension() != ".tum") continue;
      SCOPED_TRACE(entry.path().filename());
      std::ifstream file(entry.path());
      std::string motion;
      int lines = 0;
      for (std::string line; lines < max_lines && std::getline(file, line); ++lines) motion += line + "\n";
      folder_.write("recorded.tum", motion);
      const Outcome outcome =
          run("--scene box.urdf --motion recorded.tum --set grasp.object=box --set start.follow=true "
              "--set contact=none --out run.csv");
      ASSERT_EQ(outcome.status, 0) << outcome.err;
      for (const std::string& text : {content(path("run.csv")), outcome.out}) {
        EXPECT_EQ(text.find("nan"), std::string::npos);
        EXPECT_EQ(text.find("inf"), std::string::npos);
      }
      EXPECT_GT(summary_of(outcome)["outputs"].as<int>(), min_outputs);
    }
  }
};

TEST_F(FoldersOfMotions, HandsByFormulaRun) { expect_finite(test_support::checkout("test/data/reference"), 49); }

TEST_F(FoldersOfMotions, RecordedHandsRun) {
  const std::string folder = test_support::extra_data("data/motions");
  if (folder.empty()) GTEST_SKIP() << "SPRING_WORKBENCH_TEST_DATA is not given";
  expect_finite(folder, 1000);
}

}  // namespace
}  // namespace spring_workbench
