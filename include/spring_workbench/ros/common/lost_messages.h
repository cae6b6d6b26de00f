#pragma once

#include <diagnostic_msgs/DiagnosticStatus.h>

#include <cstddef>
#include <map>
#include <string>
#include <utility>

namespace spring_workbench::ros_common {

/// Counts the messages that came while the queue of one of this node's subscribers was full: the oldest in it was lost
/// for each. What a sender loses in a queue of its own is not seen here; nor, where a topic has several senders, what
/// is lost of those that connected before the newest: roscpp reports that one alone.
class LostMessages {
 public:
  /// The topics with their counts since the start, as a status of /diagnostics: WARN where a message was lost since the
  /// last call. `name`: of the node.
  diagnostic_msgs::DiagnosticStatus report(const std::string& name);

 private:
  std::map<std::pair<std::string, int>, std::size_t> lost_;  ///< by topic and connection, also of past ones
};

}  // namespace spring_workbench::ros_common
