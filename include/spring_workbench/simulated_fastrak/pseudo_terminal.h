#pragma once

#include <string>
#include <string_view>

namespace spring_workbench::simulated_fastrak {

/// A pseudo-terminal: a program that opens `path()` as a serial port talks to the owner of this object.
class PseudoTerminal {
 public:
  /// Throws std::system_error if no pseudo-terminal can be opened.
  PseudoTerminal();
  ~PseudoTerminal();  ///< closes the port for programs that have opened the path
  PseudoTerminal(const PseudoTerminal&) = delete;
  PseudoTerminal& operator=(const PseudoTerminal&) = delete;

  const std::string& path() const { return path_; }

  /// Returns the bytes that have arrived; waits for some for at most `timeout` [s].
  std::string read(double timeout);

  /// Returns how many of the bytes were accepted; the others do not fit until the reader catches up.
  std::size_t write(std::string_view bytes);

 private:
  int host_ = -1;    ///< our end
  int device_ = -1;  ///< the other end, kept open so that its settings persist while its users come and go
  std::string path_;
};

}  // namespace spring_workbench::simulated_fastrak
