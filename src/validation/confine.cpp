#include "confine.h"

#include <fcntl.h>
#include <linux/audit.h>
#include <linux/filter.h>
#include <linux/seccomp.h>
#include <sys/prctl.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <cerrno>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace spring_workbench::validation {
namespace {

/// Architecture of the system call numbers; 0 if this processor is not supported.
std::uint32_t processor() {
#if defined(__x86_64__)
  return AUDIT_ARCH_X86_64;
#elif defined(__aarch64__)
  return AUDIT_ARCH_AARCH64;
#else
  return 0;
#endif
}

constexpr std::uint32_t refused[] = {
#if defined(__x86_64__)
    SYS_open,
    SYS_creat,
    SYS_unlink,
    SYS_rename,
    SYS_link,
    SYS_symlink,
    SYS_mkdir,
    SYS_rmdir,
    SYS_chmod,
    SYS_chown,
    SYS_mknod,
#endif
    SYS_socket,
    SYS_socketpair,
    SYS_connect,
    SYS_bind,
    SYS_execve,
    SYS_execveat,
    SYS_kill,
    SYS_tkill,
    SYS_tgkill,
    SYS_ptrace,
    SYS_process_vm_readv,
    SYS_process_vm_writev,
    SYS_unlinkat,
    SYS_renameat,
    SYS_renameat2,
    SYS_linkat,
    SYS_symlinkat,
    SYS_mkdirat,
    SYS_fchmodat,
    SYS_fchownat,
    SYS_mknodat,
    SYS_truncate,
    SYS_mount,
    SYS_bpf,
    SYS_io_uring_setup,  // whose operations no filter judges
    SYS_pidfd_open,
    SYS_pidfd_send_signal};

constexpr std::uint32_t writing = O_WRONLY | O_RDWR | O_CREAT | O_TRUNC;

/// The BPF program with which the kernel checks each system call.
class Filter {
 public:
  Filter() {
    load(offsetof(seccomp_data, arch));
    otherwise_refuse(BPF_JEQ, processor());
    load(offsetof(seccomp_data, nr));
    refuse(BPF_JGE, 0x40000000);  // numbers of the x32 ABI
    for (const std::uint32_t number : refused) refuse(BPF_JEQ, number);
#ifdef SYS_openat2
    refuse(BPF_JEQ, SYS_openat2);  // its flags are in memory, which a filter cannot read
#endif
    step(BPF_JMP | BPF_JEQ | BPF_K, SYS_openat, 0, 3);
    load(offsetof(seccomp_data, args[2]));
    refuse(BPF_JSET, writing);
    step(BPF_RET | BPF_K, SECCOMP_RET_ALLOW);
  }
  bool install() {
    const sock_fprog program{static_cast<unsigned short>(steps_.size()), steps_.data()};
    return prctl(PR_SET_SECCOMP, SECCOMP_MODE_FILTER, &program) == 0;
  }

 private:
  void step(int code, std::uint32_t k, int if_so = 0, int if_not = 0) {
    steps_.push_back(
        {static_cast<std::uint16_t>(code), static_cast<std::uint8_t>(if_so), static_cast<std::uint8_t>(if_not), k});
  }
  void load(std::size_t offset) { step(BPF_LD | BPF_W | BPF_ABS, static_cast<std::uint32_t>(offset)); }
  void refuse(int test, std::uint32_t k) {
    step(BPF_JMP | test | BPF_K, k, 0, 1);
    step(BPF_RET | BPF_K, SECCOMP_RET_ERRNO | EPERM);
  }
  void otherwise_refuse(int test, std::uint32_t k) {
    step(BPF_JMP | test | BPF_K, k, 1, 0);
    step(BPF_RET | BPF_K, SECCOMP_RET_ERRNO | EPERM);
  }

  std::vector<sock_filter> steps_;
};

}  // namespace

void keep_alone(int file) {
  std::vector<int> open;
  for (const auto& entry : std::filesystem::directory_iterator("/proc/self/fd"))
    open.push_back(std::stoi(entry.path().filename()));
  for (const int one : open) {
    if (one > STDERR_FILENO && one != file) close(one);
  }
}

bool confine() {
  const bool no_new_privileges = prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0) == 0;
  return no_new_privileges && processor() != 0 && Filter().install();
}

}  // namespace spring_workbench::validation
