#include "spring_workbench/motion_files/motion_file.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <fstream>
#include <random>
#include <string>

#include "spring_workbench/motion_files/open_motion.h"
#include "spring_workbench/validation/input_error.h"
#include "support/paths.h"
#include "support/temporary_folder.h"

namespace spring_workbench::motion_files::motion_file_test {
namespace {

std::vector<motion::StylusSample> read_text(const std::string& text) {
  const test_support::TemporaryFolder folder;
  folder.write("hand.tum", text);
  return read_motion_file(folder.path("hand.tum"));
}

std::string refusal_of_file(const std::string& path) {
  try {
    read_motion_file(path);
  } catch (const validation::InputError& e) {
    return e.what();
  }
  return "";
}

/// The message that follows the file's name, where a file with this text is refused.
std::string refusal(const std::string& text) {
  const test_support::TemporaryFolder folder;
  folder.write("hand.tum", text);
  const std::string path = folder.path("hand.tum");
  const std::string message = refusal_of_file(path);
  EXPECT_EQ(message.rfind(path, 0), 0u) << message;
  return message.size() > path.size() ? message.substr(path.size()) : "";
}

TEST(MotionFile, ReadsWhatWasWritten) {
  std::mt19937 engine(1);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  std::vector<motion::StylusSample> written;
  std::string text = "# t x y z qx qy qz qw button\n";
  for (int i = 0; i < 500; ++i) {
    motion::StylusSample sample;
    sample.t = std::round(2e7 * i + 1e6 * uniform(engine) * (i > 0)) / 1e9;
    const Quaterniond q = Quaterniond(uniform(engine), uniform(engine), uniform(engine), 2.0).normalized();
    sample.X = make_transform(Vector3d(uniform(engine), uniform(engine), uniform(engine)), q);
    sample.button = uniform(engine) > 0.0;
    char line[400];
    const Vector3d p = sample.X.translation();
    std::snprintf(line, sizeof line, "%.17g\t%.17g %.17g %.17g  %.17g %.17g %.17g %.17g %d%s\n", sample.t, p.x(), p.y(),
                  p.z(), q.x(), q.y(), q.z(), q.w(), sample.button, i % 3 == 0 ? " # note\r" : "");
    text += line;
    if (i % 7 == 0) text += "\n   \n#\n";
    written.push_back(sample);
  }
  const std::vector<motion::StylusSample> read = read_text(text);
  ASSERT_EQ(read.size(), written.size());
  for (std::size_t i = 0; i < read.size(); ++i) {
    EXPECT_EQ(read[i].t, written[i].t);
    EXPECT_EQ(read[i].X.translation(), written[i].X.translation());
    EXPECT_LT((read[i].X.linear() - written[i].X.linear()).norm(), 1e-14);
    EXPECT_EQ(read[i].button, written[i].button);
  }
}

/// Stamps since 1970 keep their nanoseconds; repeated and backward ones are kept.
TEST(MotionFile, TimesAreRelativeToTheFirstStamp) {
  const auto samples = read_text(
      "1520530753.382632017 1 2 3 0 0 0 1\n1520530753.382632018 1 2 3 0 0 0 1\n"
      "1520530753.382632018 1 2 3 0 0 0 1\n1520530752.382632017 1 2 3 0 0 0 1\n");
  ASSERT_EQ(samples.size(), 4u);
  EXPECT_EQ(samples[0].t, 0.0);
  EXPECT_EQ(samples[1].t, 1e-9);
  EXPECT_EQ(samples[2].t, samples[1].t);
  EXPECT_EQ(samples[3].t, -1.0);
  EXPECT_EQ(samples[3].X.translation(), Vector3d(1, 2, 3));
}

TEST(MotionFile, QuaternionsWithinReasonAreNormalised) {
  for (const motion::StylusSample& sample : read_text("0 0 0 0 0 0 0.9 0.9\n1 0 0 0 0 0 -0.5 -0.5\n")) {
    EXPECT_LT((sample.X.linear() * Vector3d::UnitX() - Vector3d::UnitY()).norm(), 1e-15);
  }
}

TEST(MotionFile, BadLinesNameFileLineFieldValueAndRule) {
  struct Bad {
    const char* line;
    const char* expected;  // after "file:3: "
  };
  const Bad table[] = {
      {"abc 0 0 0 0 0 0 1", "t: invalid value 'abc': expected a number between -1e12 and 1e12 s"},
      {"nan 0 0 0 0 0 0 1", "t: invalid value 'nan': expected a number between -1e12 and 1e12 s"},
      {"1 0 inf 0 0 0 0 1", "y: invalid value 'inf': expected a number between -1e9 and 1e9 m"},
      {"1 0 0 1e400 0 0 0 1", "z: invalid value '1e400': expected a number between -1e9 and 1e9 m"},
      {"1 2e9 0 0 0 0 0 1", "x: invalid value '2e9': expected a number between -1e9 and 1e9 m"},
      {"1 0,5 0 0 0 0 0 1", "x: invalid value '0,5': expected a number between -1e9 and 1e9 m"},
      {"1 0.5.1 0 0 0 0 0 1", "x: invalid value '0.5.1': expected a number between -1e9 and 1e9 m"},
      {"1 0 0 0 NaN 0 0 1", "qx: invalid value 'NaN': expected a number between -2 and 2"},
      {"1 0 0 0 0 0 0 0", "norm of qx qy qz qw: invalid value '0': expected a number between 0.5 and 2"},
      {"1 0 0 0 0 0 0 0.1", "norm of qx qy qz qw: invalid value '0.1': expected a number between 0.5 and 2"},
      {"1 0 0 0 2 2 2 2", "norm of qx qy qz qw: invalid value '4': expected a number between 0.5 and 2"},
      {"1 0 0 0 0 0 1", "line: expected t x y z qx qy qz qw [button], got 7 fields"},
      {"1 0 0 0 0 0 0 1 1 1", "line: expected t x y z qx qy qz qw [button], got 10 fields"},
      {"1 0 0 0 0 0 0 1 1", "line: expected 8 fields, as in the lines before, got 9"},
  };
  for (const Bad& bad : table) {
    const std::string text = std::string("# comment\n0 0 0 0 0 0 0 1\n") + bad.line + "\n2 0 0 0 0 0 0 1\n";
    const std::string start = std::string(":3: ") + bad.expected;
    EXPECT_EQ(refusal(text).substr(0, start.size()), start);
  }
  EXPECT_EQ(refusal("0 0 0 0 0 0 0 1 0\n1 0 0 0 0 0 0 1 2\n"), ":2: button: invalid value '2': expected 0 or 1");
}

TEST(MotionFile, AByteOrderMarkIsIgnored) {
  EXPECT_EQ(read_text("\xEF\xBB\xBF"
                      "0 1 2 3 0 0 0 1\n1 1 2 3 0 0 0 1\n")
                .size(),
            2u);
  EXPECT_EQ(read_text("\xEF\xBB\xBF# t x y z\n0 1 2 3 0 0 0 1\n").size(), 1u);
}

TEST(MotionFile, AFileWithoutSamplesIsRefused) {
  for (const char* text : {"", "\n\n", "# only a comment"}) {
    EXPECT_EQ(refusal(text).rfind(": expected lines of t x y z", 0), 0u);
  }
  EXPECT_EQ(refusal_of_file("/nonexistent/a.tum").rfind("/nonexistent/a.tum: expected a readable", 0), 0u);
  EXPECT_EQ(refusal_of_file("/tmp").rfind("/tmp: ", 0), 0u) << "a folder is no file";
}

TEST(RecordedSource, GivesEverySampleOnce) {
  std::vector<motion::StylusSample> samples(5);
  for (std::size_t i = 0; i < samples.size(); ++i) samples[i].t = static_cast<double>(i);
  RecordedSource source(samples);
  for (const motion::StylusSample& expected : samples) {
    const auto sample = source.next();
    ASSERT_TRUE(sample);
    EXPECT_EQ(sample->t, expected.t);
  }
  EXPECT_FALSE(source.next());
  EXPECT_FALSE(source.next());
}

/// The motion in a file can be interpolated without anything that is not finite; its end [s].
double end_of_finite_motion(const std::string& path) {
  SCOPED_TRACE(path);
  motion::PoseTrack track;
  const auto source = open_motion(path);
  while (const auto sample = source->next()) track.push(*sample);
  EXPECT_EQ(track.begin(), 0.0);
  for (double t = 0.0; t < track.end(); t += 0.007) {
    const motion::MotionState state = track.segment(t).at(t);
    const bool finite = state.X.matrix().allFinite() && state.velocity.linear.allFinite() &&
                        state.velocity.angular.allFinite() && state.acceleration.linear.allFinite() &&
                        state.acceleration.angular.allFinite();
    EXPECT_TRUE(finite) << "at t = " << t;
    if (!finite) break;
  }
  return track.end();
}

TEST(MotionsByFormula, GiveFiniteMotion) {
  for (const char* name : {"motion_swing", "motion_reach", "motion_reach_1s"}) {
    EXPECT_GE(end_of_finite_motion(test_support::checkout("test/data/reference/") + name + ".tum"), 1.0);
  }
}

TEST(RecordedMotions, GiveFiniteMotion) {
  const std::string folder = test_support::extra_data("data/motions/");
  if (folder.empty()) GTEST_SKIP() << "SPRING_WORKBENCH_TEST_DATA is not given";
  for (const char* name : {"falcon5_unsorted_stamps", "plus_probe_watertank_updown", "plus_stylus_8landmarks_60s",
                           "tango_hard_caligula_60s", "tum_fr1_xyz", "tumvi_room2_gaps_60s", "tumvi_room5_fast_45s",
                           "vicon_handheld_primesense1_60s"}) {
    EXPECT_GT(end_of_finite_motion(folder + name + ".tum"), 20.0);
  }
}

}  // namespace
}  // namespace spring_workbench::motion_files::motion_file_test
