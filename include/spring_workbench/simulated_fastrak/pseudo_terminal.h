#pragma once

#include <string>
#include <string_view>

namespace spring_workbench::simulated_fastrak {

/// A cable: what opens `path()` as a serial port talks to the holder of this object.
class PseudoTerminal {
 public:
  /// Throws std::system_error if none can be opened.
  PseudoTerminal();
  ~PseudoTerminal();  ///< programs that have opened the path lose it
  PseudoTerminal(const PseudoTerminal&) = delete;
  PseudoTerminal& operator=(const PseudoTerminal&) = delete;

  const std::string& path() const { return path_; }

  /// What has come; waits for it, at most `timeout` [s].
  std::string read(double timeout);

  /// How many of the bytes were accepted; the others do not fit until the reader catches up.
  std::size_t write(std::string_view bytes);

 private:
  int host_ = -1;    ///< our end
  int device_ = -1;  ///< the other end, held open so that its settings stay and its users may come and go
  std::string path_;
};

}  // namespace spring_workbench::simulated_fastrak
