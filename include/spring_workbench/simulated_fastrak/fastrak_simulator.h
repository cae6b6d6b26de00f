#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <vector>

#include "spring_workbench/simulated_fastrak/fastrak_device.h"
#include "spring_workbench/simulated_fastrak/line_faults.h"
#include "spring_workbench/simulated_fastrak/pseudo_terminal.h"

namespace spring_workbench::simulated_fastrak {

/// A FASTRAK on a pseudo-terminal, with faults. Time is the caller's.
class FastrakSimulator {
 public:
  /// `link`: a symbolic link to the pseudo-terminal, re-created whenever that changes; empty: none. Throws InputError
  /// if something other than a link is there, or none can be made.
  FastrakSimulator(FastrakDevice device, LineFaults faults, std::string link = "");
  ~FastrakSimulator();  ///< removes the link
  FastrakSimulator(const FastrakSimulator&) = delete;
  FastrakSimulator& operator=(const FastrakSimulator&) = delete;

  /// Path of the pseudo-terminal; empty while it is unplugged.
  std::string path() const { return terminal_ ? terminal_->path() : ""; }

  /// Reads commands of the host, responds, and sends what is due; waits for the host, at most `timeout` [s].
  void serve(double timeout);

  /// One cycle at time `t` [s], later than the last one.
  void measure(double t);
  const FastrakDevice& device() const { return device_; }
  std::size_t waiting() const { return waiting_.size(); }   ///< bytes that have not been read yet
  std::size_t records_sent() const { return sent_; }        ///< data records, whole or spoilt
  std::size_t records_dropped() const { return dropped_; }  ///< because they were not read

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
