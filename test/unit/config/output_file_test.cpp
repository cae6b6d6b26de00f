#include "spring_workbench/config/output_file.h"

#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "spring_workbench/validation/input_error.h"
#include "support/temporary_folder.h"

namespace {

std::vector<std::string> calls;  // of the system, in their order

std::string kind(int descriptor) {
  struct stat status {};
  fstat(descriptor, &status);
  return S_ISDIR(status.st_mode) ? "folder" : std::to_string(status.st_size) + " bytes";
}

}  // namespace

// Replaces the C library's function, to record the order of flush and rename.
extern "C" int fsync(int descriptor) {
  calls.push_back("fsync " + kind(descriptor));
  return static_cast<int>(syscall(SYS_fsync, descriptor));
}
extern "C" int rename(const char* from, const char* to) noexcept {
  calls.push_back("rename");
  return static_cast<int>(syscall(SYS_rename, from, to));
}

namespace spring_workbench::config::output_file_test {
namespace {

namespace fs = std::filesystem;

std::string text_of(const std::string& path) {
  std::ifstream file(path);
  return {std::istreambuf_iterator<char>(file), {}};
}

std::string refusal(const std::string& path, const std::string& text) {
  try {
    OutputFile file(path);
    file.write(text);
    file.commit();
  } catch (const validation::InputError& error) {
    return error.what();
  }
  return "";
}

std::size_t files_in(const fs::path& folder) {
  return static_cast<std::size_t>(std::distance(fs::directory_iterator(folder), fs::directory_iterator()));
}

TEST(OutputFile, IsOnTheDiskBeforeItHasItsName) {
  const test_support::TemporaryFolder folder;
  const std::string path = folder.path("a.txt");
  ASSERT_EQ(refusal(path, "old"), "");
  calls.clear();
  {
    OutputFile file(path);
    file.write("the ");
    file.write("new");
    EXPECT_EQ(text_of(path), "old");
    file.commit();
  }
  EXPECT_EQ(calls, (std::vector<std::string>{"fsync 7 bytes", "rename", "fsync folder"}));
  EXPECT_EQ(text_of(path), "the new");
  EXPECT_EQ(files_in(folder.path("")), 1u);
}

TEST(OutputFile, WithoutCommitNothingIsThere) {
  const test_support::TemporaryFolder folder;
  OutputFile(folder.path("a.txt")).write("text");
  EXPECT_EQ(files_in(folder.path("")), 0u);
}

TEST(OutputFile, AKilledProcessLeavesNothing) {
  const test_support::TemporaryFolder folder;
  for (const int signal : {SIGINT, SIGTERM, SIGKILL}) {
    const pid_t child = fork();
    if (child == 0) {
      std::signal(signal, SIG_DFL);
      OutputFile file(folder.path("a.txt"));
      file.write(std::string(100000, 'x'));
      raise(signal);
      _exit(0);
    }
    int status = 0;
    ASSERT_EQ(waitpid(child, &status, 0), child);
    EXPECT_EQ(WTERMSIG(status), signal);
    EXPECT_EQ(files_in(folder.path("")), 0u);
  }
}

/// E.g. for a header with the length of the rest.
TEST(OutputFile, TheBeginCanBeReplacedWhileMoreFollows) {
  const test_support::TemporaryFolder folder;
  const std::string path = folder.path("a.txt");
  OutputFile file(path);
  file.write("0000 of");
  file.write_begin("1234");
  file.write(" bytes");
  file.commit();
  EXPECT_EQ(text_of(path), "1234 of bytes");
}

TEST(OutputFile, OnAFullDiskTheOldFileStays) {
  const test_support::TemporaryFolder folder;
  const std::string path = folder.path("a.txt");
  ASSERT_EQ(refusal(path, "old"), "");
  std::signal(SIGXFSZ, SIG_IGN);
  rlimit before{};
  getrlimit(RLIMIT_FSIZE, &before);
  const rlimit small{10000, before.rlim_max};
  for (const std::size_t size : {10001u, 1000000u}) {  // found by the last flush, and by a write
    setrlimit(RLIMIT_FSIZE, &small);
    const std::string told = refusal(path, std::string(size, 'x'));
    setrlimit(RLIMIT_FSIZE, &before);
    EXPECT_EQ(told, path + ": cannot be written: File too large");
    EXPECT_EQ(text_of(path), "old");
    EXPECT_EQ(files_in(folder.path("")), 1u);
  }
  EXPECT_EQ(refusal("/dev/full", "x"), "/dev/full: cannot be written: No space left on device");
}

TEST(OutputFile, AnUnwritablePathIsReported) {
  const test_support::TemporaryFolder folder;
  EXPECT_EQ(refusal(folder.path(""), "x"), folder.path("") + ": cannot be written: it is a folder");
  const std::string path = folder.path("none/a.txt");
  EXPECT_EQ(refusal(path, "x"), path + ": cannot be written: No such file or directory");
}

TEST(OutputFile, APipeIsWrittenInPlace) {
  EXPECT_EQ(refusal("/dev/null", "text"), "");
  EXPECT_TRUE(fs::is_character_file("/dev/null"));
}

}  // namespace
}  // namespace spring_workbench::config::output_file_test
