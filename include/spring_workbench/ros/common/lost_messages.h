#pragma once

#include <diagnostic_msgs/DiagnosticStatus.h>

#include <cstddef>
#include <map>
#include <string>
#include <utility>

namespace spring_workbench::ros_common {

/// Counts the messages that were dropped because the queue of one of this node's subscribers was full. Messages that a
/// publisher drops from its own queue are not counted. If a topic has several publishers, only drops of the one that
/// connected last are counted, because roscpp reports no others.
class LostMessages {
 public:
  /// The topics with their counts since the start, as a status of /diagnostics: WARN if a message was lost since the
  /// last call. `name`: name of the node.
  diagnostic_msgs::DiagnosticStatus report(const std::string& name);

 private:
  std::map<std::pair<std::string, int>, std::size_t> lost_;  ///< by topic and connection, including closed connections
};

}  // namespace spring_workbench::ros_common
