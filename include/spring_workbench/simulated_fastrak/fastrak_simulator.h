#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <vector>

#include "spring_workbench/simulated_fastrak/fastrak_device.h"
#include "spring_workbench/simulated_fastrak/line_faults.h"
#include "spring_workbench/simulated_fastrak/pseudo_terminal.h"

namespace spring_workbench::simulated_fastrak {

/// A simulated FASTRAK on a pseudo-terminal, with faults. The caller provides the time.
class FastrakSimulator {
 public:
  /// `link`: path of a symbolic link to the pseudo-terminal, updated whenever that changes; empty: no link. Throws
  /// InputError if something other than a link exists there, or if the link cannot be created.
  FastrakSimulator(FastrakDevice device, LineFaults faults, std::string link = "");
  ~FastrakSimulator();  ///< removes the link
  FastrakSimulator(const FastrakSimulator&) = delete;
  FastrakSimulator& operator=(const FastrakSimulator&) = delete;

  /// Path of the pseudo-terminal; empty while it is unplugged.
  std::string path() const { return terminal_ ? terminal_->path() : ""; }

  /// Reads and answers commands of the host and sends pending bytes; waits for the host for at most `timeout` [s].
  void serve(double timeout);

  /// Runs one measurement cycle at time `t` [s], later than the last one.
  void measure(double t);
  const FastrakDevice& device() const { return device_; }
  std::size_t waiting() const { return waiting_.size(); }   ///< bytes that the host has not read yet
  std::size_t records_sent() const { return sent_; }        ///< data records, intact or corrupted
  std::size_t records_dropped() const { return dropped_; }  ///< because the host did not read them

 private:
  void plug_in();
  void unplug();
  void send(const std::string& bytes);

  FastrakDevice device_;
  LineFaults faults_;
  const std::string link_;
  std::unique_ptr<PseudoTerminal> terminal_;
  std::string waiting_;
  double t_ = -1.0;
  std::size_t sent_ = 0, dropped_ = 0;
};

}  // namespace spring_workbench::simulated_fastrak
