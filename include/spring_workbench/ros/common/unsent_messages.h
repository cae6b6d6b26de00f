#pragma once

#include <map>
#include <string>

#include "spring_workbench/ros/common/dropped_messages.h"

namespace spring_workbench::ros_common {

/// Counts the messages of this process that roscpp does not send, because a subscriber reads too slowly and the
/// publisher's queue is full. roscpp drops them silently, but tells what it put into the queue of each connection, and
/// the system what it was given.
class UnsentMessages {
 public:
  /// Reads the figures of all connections; to be called about once a second. Returns the number of messages that were
  /// not sent so far, by "TOPIC to NODE", only of subscribers that missed some.
  const std::map<std::string, double>& update();

 private:
  std::map<int, DroppedMessages> connections_;  ///< by roscpp's number of the connection
  std::map<std::string, double> unsent_;
};

}  // namespace spring_workbench::ros_common
