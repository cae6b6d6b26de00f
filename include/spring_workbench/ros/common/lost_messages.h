#pragma once

#include <diagnostic_msgs/DiagnosticStatus.h>

#include <cstddef>
#include <string>

namespace spring_workbench::ros_common {

/// Reports the messages that this process' counted subscribers have lost. Messages that a publisher drops from its own
/// queue cannot be counted, because roscpp drops them silently; the receiver can tell by a gap in `header.seq`.
class LostMessages {
 public:
  /// The topics with their counts since the start, as a status of /diagnostics: WARN if a message was lost since the
  /// last call. `name`: name of the node.
  diagnostic_msgs::DiagnosticStatus report(const std::string& name);

 private:
  std::size_t reported_ = 0;
};

}  // namespace spring_workbench::ros_common
