#pragma once

#include <diagnostic_msgs/DiagnosticStatus.h>

#include <cstddef>
#include <map>
#include <string>

#include "spring_workbench/ros/common/unsent_messages.h"

namespace spring_workbench::ros_common {

/// Reports the messages that this process' counted subscribers have lost, and those that it could not send.
class LostMessages {
 public:
  /// The topics with their counts since the start, as a status of /diagnostics: WARN if a message was lost since the
  /// last call. `name`: name of the node. To be called about once a second.
  diagnostic_msgs::DiagnosticStatus report(const std::string& name);

 private:
  std::size_t reported_ = 0;
  std::map<std::string, long> reported_unsent_;  ///< by "TOPIC to NODE"
  UnsentMessages unsent_;
};

}  // namespace spring_workbench::ros_common
