#include "spring_workbench/validation/run_in_child.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <linux/filter.h>
#include <linux/seccomp.h>
#include <sys/prctl.h>
#include <sys/ptrace.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstddef>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <fstream>
#include <memory>
#include <stdexcept>
#include <thread>
#include <vector>

#include "spring_workbench/validation/input_error.h"

namespace spring_workbench::validation {
namespace {

constexpr std::uint64_t mebibyte = std::uint64_t{1} << 20;
constexpr ChildLimits ample{60.0};
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
constexpr bool sanitized = true;
#else
constexpr bool sanitized = false;
#endif

/// From now on the process, and what it forks, has a kernel without filters.
void remove_filters() {
  sock_filter steps[] = {BPF_STMT(BPF_LD | BPF_W | BPF_ABS, offsetof(seccomp_data, nr)),
                         BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, SYS_prctl, 0, 3),
                         BPF_STMT(BPF_LD | BPF_W | BPF_ABS, offsetof(seccomp_data, args[0])),
                         BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, PR_SET_SECCOMP, 0, 1),
                         BPF_STMT(BPF_RET | BPF_K, SECCOMP_RET_ERRNO | EINVAL),
                         BPF_STMT(BPF_RET | BPF_K, SECCOMP_RET_ALLOW)};
  const sock_fprog program{static_cast<unsigned short>(std::size(steps)), steps};
  prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0);
  prctl(PR_SET_SECCOMP, SECCOMP_MODE_FILTER, &program);  // where this fails there are none
}

TEST(RunInChild, SaysOnceWhereTheKernelFiltersNothing) {
  int ends[2];
  ASSERT_EQ(pipe(ends), 0);
  const pid_t process = fork();
  ASSERT_GE(process, 0);
  if (process == 0) {
    dup2(ends[1], STDERR_FILENO);
    close(ends[0]);
    close(ends[1]);
    remove_filters();
    bool right = true;
    for (int i = 0; i < 3; ++i) right = right && run_in_child([] { return std::string("done"); }, ample) == "done";
    _exit(right ? 0 : 1);
  }
  close(ends[1]);
  std::string said;
  for (char c = 0; read(ends[0], &c, 1) == 1;) said += c;
  close(ends[0]);
  int status = 0;
  ASSERT_EQ(waitpid(process, &status, 0), process);
  EXPECT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) == 0);
  EXPECT_NE(said.find("no seccomp filter"), std::string::npos) << said;
  EXPECT_EQ(std::count(said.begin(), said.end(), '\n'), 1) << said;
}

TEST(RunInChild, BringsBackEveryByte) {
  for (const std::size_t size : {std::size_t{0}, std::size_t{1}, std::size_t{65536}, std::size_t{10000001}}) {
    std::string sent(size, '\0');
    for (std::size_t i = 0; i < size; ++i) sent[i] = static_cast<char>(i * i % 251);
    EXPECT_TRUE(run_in_child([&] { return sent; }, ample) == sent) << size;
  }
}

TEST(RunInChild, LeavesTheCallerAsItWas) {
  int touched = 0;
  EXPECT_EQ(run_in_child([&] { return std::to_string(++touched); }, ample), "1");
  EXPECT_EQ(touched, 0);
}

TEST(RunInChild, ComesBackWithNothingFromWhatDies) {
  EXPECT_FALSE(run_in_child([]() -> std::string { std::abort(); }, ample));
  EXPECT_FALSE(run_in_child([]() -> std::string { throw std::runtime_error("no"); }, ample));
  EXPECT_FALSE(run_in_child([]() -> std::string { throw 1; }, ample));
}

TEST(RunInChild, ComesBackWithNothingFromWhatHangs) {
  EXPECT_FALSE(run_in_child(
      [] {
        for (volatile bool always = true; always;) {
        }
        return std::string();
      },
      {0.2}));
}

TEST(RunInChild, TellsTheProcessorTimeThatItTook) {
  const auto work = [](double seconds) {
    return [seconds] {
      while (static_cast<double>(std::clock()) < seconds * CLOCKS_PER_SEC) {
      }
      return std::string();
    };
  };
  double little = 0.0, more = 0.0;
  ASSERT_TRUE(run_in_child(work(0.0), ample, &little));
  ASSERT_TRUE(run_in_child(work(0.3), ample, &more));
  EXPECT_GE(more, 0.28);
  EXPECT_LT(little, more);
}

/// What a file that takes over its reader would try.
TEST(RunInChild, HasNoFileOfTheCallerAndReachesNothing) {
  int ends[2];
  ASSERT_EQ(socketpair(AF_UNIX, SOCK_STREAM, 0, ends), 0);
  const std::string path = testing::TempDir() + "run_in_child_test";
  std::ofstream(path) << "kept";
  const pid_t caller = getpid();
  const auto told = run_in_child(
      [&] {
        const auto refused = [](long result) { return result < 0 && errno == EPERM ? '1' : '0'; };
        const bool is_open = fcntl(ends[0], F_GETFD) >= 0 || fcntl(ends[1], F_GETFD) >= 0;
        std::string answers(1, is_open ? '0' : '1');
        answers += prctl(PR_GET_NO_NEW_PRIVS, 0, 0, 0, 0) == 1 ? '1' : '0';
        answers += std::ifstream(path).good() ? '1' : '0';  // reading is what it is for
        answers += refused(socket(AF_INET, SOCK_STREAM, 0));
        answers += refused(open(path.c_str(), O_WRONLY));
        answers += refused(open((path + "_new").c_str(), O_CREAT | O_RDONLY, 0600));
        answers += refused(syscall(SYS_tgkill, caller, caller, 0));
        answers += refused(syscall(SYS_io_uring_setup, 1, nullptr));
        answers += refused(unlink(path.c_str()));
        answers += refused(rename(path.c_str(), (path + "_moved").c_str()));
        answers += refused(truncate(path.c_str(), 0));
        answers += refused(kill(caller, 0));
        answers += refused(ptrace(PTRACE_ATTACH, caller, nullptr, nullptr));
        answers += refused(execl("/bin/true", "true", nullptr));
        return answers;
      },
      ample);
  EXPECT_EQ(told, "11111111111111");
  std::string left;
  std::getline(std::ifstream(path), left);
  EXPECT_EQ(left, "kept");
  for (const int end : ends) close(end);
  std::remove(path.c_str());
}

TEST(RunInChild, ComesBackWithNothingFromWhatEatsMemory) {
  if (sanitized) GTEST_SKIP() << "a sanitizer's own memory counts, and it does not come back from a limit";
  const auto allocate = [](std::size_t megabytes) {
    return [megabytes] {
      std::vector<std::unique_ptr<std::string>> allocated;
      for (std::size_t i = 0; i < megabytes; ++i) allocated.push_back(std::make_unique<std::string>(mebibyte, 'x'));
      return std::to_string(allocated.size());
    };
  };
  EXPECT_EQ(run_in_child(allocate(20), {60.0, 200 * mebibyte}), "20");
  EXPECT_FALSE(run_in_child(allocate(400), {60.0, 200 * mebibyte}));
}

/// As a node needs it: a scene is then refused, and the node goes on.
TEST(RunInChild, RefusesWhereTheSystemGivesNoProcess) {
  rlimit before{};
  ASSERT_EQ(getrlimit(RLIMIT_NOFILE, &before), 0);
  const rlimit none{0, before.rlim_max};
  ASSERT_EQ(setrlimit(RLIMIT_NOFILE, &none), 0);
  std::string response;
  try {
    run_in_child([] { return std::string(); }, ample);
  } catch (const InputError& refusal) {
    response = refusal.what();
  }
  ASSERT_EQ(setrlimit(RLIMIT_NOFILE, &before), 0);
  EXPECT_EQ(response,
            "child process: cannot be created (Too many open files); files are read in a child process, so that a bad "
            "file does no harm");
  EXPECT_EQ(run_in_child([] { return std::string("again"); }, ample), "again");
}

TEST(RunInChild, FromManyThreadsAtOnce) {
  if (sanitized) GTEST_SKIP() << "a sanitizer's memory is not made for a fork while other threads take some";
  std::vector<std::thread> threads;
  std::vector<int> right(8, 0);
  for (std::size_t i = 0; i < right.size(); ++i) {
    threads.emplace_back([&right, i] {
      for (int k = 0; k < 10; ++k)
        right[i] += run_in_child([i] { return std::string(100000, static_cast<char>(i)); }, ample) ==
                    std::string(100000, static_cast<char>(i));
    });
  }
  for (std::thread& thread : threads) thread.join();
  EXPECT_EQ(right, std::vector<int>(8, 10));
}

}  // namespace
}  // namespace spring_workbench::validation
