#include "spring_workbench/simulated_fastrak/pseudo_terminal.h"

#include <fcntl.h>
#include <poll.h>
#include <termios.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstdlib>
#include <system_error>

namespace spring_workbench::simulated_fastrak {
namespace {

[[noreturn]] void fail(const std::string& what) { throw std::system_error(errno, std::generic_category(), what); }

}  // namespace

PseudoTerminal::PseudoTerminal() {
  host_ = posix_openpt(O_RDWR | O_NOCTTY | O_NONBLOCK | O_CLOEXEC);
  std::array<char, 128> name{};
  if (host_ < 0 || grantpt(host_) != 0 || unlockpt(host_) != 0 || ptsname_r(host_, name.data(), name.size()) != 0) {
    fail("pseudo-terminal");
  }
  path_ = name.data();
  device_ = open(path_.c_str(), O_RDWR | O_NOCTTY | O_CLOEXEC);
  termios settings{};
  if (device_ < 0 || tcgetattr(device_, &settings) != 0) fail(path_);
  cfmakeraw(&settings);  // otherwise the terminal would echo input and convert CR to LF
  if (tcsetattr(device_, TCSANOW, &settings) != 0) fail(path_);
}

PseudoTerminal::~PseudoTerminal() {
  close(host_);
  close(device_);
}

std::string PseudoTerminal::read(double timeout) {
  pollfd waiting{host_, POLLIN, 0};
  std::array<char, 4096> bytes{};
  if (poll(&waiting, 1, static_cast<int>(timeout * 1e3)) <= 0) return "";
  const ssize_t size = ::read(host_, bytes.data(), bytes.size());
  return size > 0 ? std::string(bytes.data(), static_cast<std::size_t>(size)) : std::string();
}

std::size_t PseudoTerminal::write(std::string_view bytes) {
  const ssize_t size = ::write(host_, bytes.data(), bytes.size());
  if (size < 0 && errno != EAGAIN && errno != EINTR) fail(path_);
  return size > 0 ? static_cast<std::size_t>(size) : 0;
}

}  // namespace spring_workbench::simulated_fastrak
