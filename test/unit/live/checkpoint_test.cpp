#include "spring_workbench/live/checkpoint.h"

#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/stat.h>

#include <cctype>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "spring_workbench/validation/input_error.h"
#include "support/bench_scenes.h"
#include "support/temporary_folder.h"

namespace spring_workbench::live::checkpoint_test {
namespace {

namespace fs = std::filesystem;

template <typename Do>
std::string refusal(Do&& act) {
  try {
    act();
  } catch (const validation::InputError& error) {
    EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos) << error.what();
    return error.what();
  }
  return "";
}

/// A session with a box on the bench and edits.
struct Session {
  Session() {
    scene::Scene scene =
        scene_of({box("box", Vector3d(0.1, 0.06, 0.04), 1.0, Vector3d(0.0, 0.0, 0.02))}, scene::ContactMode::none);
    runner.emplace(scene, simulation::SimulationSettings(), hand_input::InputSettings(), false);
  }
  void move(double x) {
    Command command;
    command.kind = Command::Kind::edit;
    command.edit.name = "box";
    command.edit.X_WL = make_transform(Vector3d(x, 0.0, 0.02), Quaterniond::Identity());
    runner->change("edit_object", command);
  }
  Vector3d place() const {
    return runner->locked([](const auto& simulation) { return Vector3d(simulation.objects()[0].X_WO.translation()); });
  }
  std::optional<SimulationRunner> runner;
};

TEST(Checkpoint, AnotherRunnerGoesOnFromItsText) {
  Session first, second;
  Checkpoint kept(*first.runner, "a.urdf"), other(*second.runner, "a.urdf");
  std::vector<std::string> texts;
  const auto write = [&](const std::string& text) { texts.push_back(text); };
  kept.keep(write);
  kept.keep(write);
  ASSERT_EQ(texts.size(), 1u);  // nothing has changed
  first.move(0.123456789);
  EXPECT_THROW(kept.keep([](const std::string&) { throw std::runtime_error("full"); }), std::runtime_error);
  kept.keep(write);
  ASSERT_EQ(texts.size(), 2u);
  other.resume(texts[1], "file", {});
  EXPECT_EQ(second.place(), first.place());
  kept.forget();
  kept.keep(write);
  EXPECT_EQ(texts.size(), 3u);
}

/// A truncated text, or one with any changed digit, is not used at all.
TEST(Checkpoint, OfADamagedTextNothingIsUsed) {
  Session first, second;
  first.move(0.1);
  std::string text;
  Checkpoint(*first.runner, "a.urdf").keep([&](const std::string& now) { text = now; });
  Checkpoint other(*second.runner, "a.urdf");
  const Vector3d before = second.place();
  for (std::size_t length = 0; length + 2 < text.size(); length += 1 + text.size() / 97) {
    EXPECT_NE(refusal([&] { other.resume(text.substr(0, length), "file", {}); }), "") << length;
  }
  const std::size_t numbers = text.find("numbers");
  for (std::size_t at = numbers; at < text.size(); at += 1 + text.size() / 97) {
    std::string spoilt = text;
    if (!std::isxdigit(static_cast<unsigned char>(spoilt[at]))) continue;
    spoilt[at] = spoilt[at] == '7' ? '8' : '7';
    EXPECT_NE(refusal([&] { other.resume(spoilt, "file", {}); }), "") << at;
  }
  EXPECT_EQ(refusal([&] { Checkpoint(*second.runner, "b.urdf").resume(text, "file", {}); }),
            "file: given_scene: the checkpoint is of 'a.urdf', but the node was started with 'b.urdf'");
  EXPECT_EQ(second.place(), before);
  other.resume(text, "file", {});
  EXPECT_EQ(second.place(), first.place());
}

TEST(CheckpointFile, HoldsWhatWasWrittenLast) {
  const test_support::TemporaryFolder folder;
  const CheckpointFile file(folder.path("a"));
  EXPECT_EQ(file.read(), "");
  file.remove();
  file.write("one");
  const std::string long_text(200001, 'x');
  file.write(long_text);
  EXPECT_EQ(CheckpointFile(folder.path("a")).read(), long_text);
  file.set_aside();
  EXPECT_EQ(file.read(), "");
  EXPECT_EQ(CheckpointFile(folder.path("a.ignored")).read(), long_text);
  file.write("two");
  file.remove();
  EXPECT_FALSE(fs::exists(folder.path("a")));
}

/// Otherwise a FIFO would block, an endless device be read forever, a link be followed, or a foreign file be replaced.
TEST(CheckpointFile, WhatIsNotOursIsLeftAlone) {
  const test_support::TemporaryFolder folder;
  CheckpointFile(folder.path("ours")).write("text");
  std::ofstream(folder.path("other")) << "somebody's work, longer than the line that a checkpoint begins with";
  std::ofstream(folder.path("empty")).flush();
  fs::create_directory(folder.path("folder"));
  fs::create_symlink(folder.path("ours"), folder.path("link"));
  fs::create_symlink(folder.path("nowhere"), folder.path("dangling"));
  ASSERT_EQ(mkfifo(folder.path("fifo").c_str(), 0600), 0);
  const auto message = [](const std::string& path, const std::string& reason) {
    return "manipulation: checkpoint_file: invalid value '" + path +
           "': expected the path of a checkpoint or of a new file, in a writable folder (" + reason + ")";
  };
  const auto expect_refused = [&](const std::string& path, const std::string& reason) {
    const CheckpointFile file(path);
    const std::string told = message(path, reason);
    EXPECT_EQ(refusal([&] { file.read(); }), told);
    EXPECT_EQ(refusal([&] { file.write("new"); }), told);
    EXPECT_EQ(refusal([&] { file.remove(); }), told);
    EXPECT_EQ(refusal([&] { file.set_aside(); }), told);
    EXPECT_TRUE(fs::exists(fs::symlink_status(path)));
  };
  expect_refused(folder.path("other"), "it belongs to another program");
  expect_refused(folder.path("empty"), "it belongs to another program");
  expect_refused(folder.path("folder"), "it is not a regular file");
  expect_refused(folder.path("link"), "it is a symbolic link");
  expect_refused(folder.path("dangling"), "it is a symbolic link");
  expect_refused(folder.path("fifo"), "it is not a regular file");
  expect_refused("/dev/zero", "it is not a regular file");
  const std::string below = folder.path("other/a");
  EXPECT_EQ(refusal([&] { CheckpointFile(below).write("x"); }), message(below, "Not a directory"));
  const std::string nowhere = folder.path("none/a");
  EXPECT_EQ(refusal([&] { CheckpointFile(nowhere).write("x"); }),
            "manipulation: checkpoint_file: " + nowhere + ": cannot be written: No such file or directory");
  EXPECT_EQ(CheckpointFile(folder.path("ours")).read(), "text");
}

TEST(CheckpointFile, OnAFullDiskTheLastOneStays) {
  const test_support::TemporaryFolder folder;
  const CheckpointFile file(folder.path("a"));
  file.write("kept");
  std::signal(SIGXFSZ, SIG_IGN);
  rlimit before{};
  getrlimit(RLIMIT_FSIZE, &before);
  const rlimit small{100, before.rlim_max};
  setrlimit(RLIMIT_FSIZE, &small);
  const std::string told = refusal([&] { file.write(std::string(1000, 'x')); });
  setrlimit(RLIMIT_FSIZE, &before);
  EXPECT_EQ(told, "manipulation: checkpoint_file: " + folder.path("a") + ": cannot be written: File too large");
  EXPECT_EQ(file.read(), "kept");
}

}  // namespace
}  // namespace spring_workbench::live::checkpoint_test
