#pragma once

#include <ros/message_traits.h>
#include <ros/serialization.h>

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

#include "spring_workbench/ObjectStates.h"
#include "spring_workbench/live/shared_states.h"

namespace spring_workbench::manipulation {

/// Serialised ObjectStates messages. The buffers of the last messages are kept; once roscpp has sent one, only the
/// header and the changed objects are overwritten for the next message.
class ObjectsMessage {
 public:
  void write(const std_msgs::Header& header, const live::SharedStates& objects);
  /// The message as from serializeMessage(), without a copy.
  ros::SerializedMessage serialised() const;

 private:
  struct Bytes {
    std::shared_ptr<std::vector<std::uint8_t>> all = std::make_shared<std::vector<std::uint8_t>>();
    live::SharedStates written;
    std::vector<std::size_t> ends;  ///< end of the bytes of each part
    void write(const std_msgs::Header& header, const live::SharedStates& objects);
  };
  std::array<Bytes, 3> kept_;
  std::size_t newest_ = 0;
};

}  // namespace spring_workbench::manipulation

// Makes roscpp treat it as an ObjectStates message.
namespace ros::message_traits {

using spring_workbench::ObjectStates;
using spring_workbench::manipulation::ObjectsMessage;

template <>
struct IsMessage<ObjectsMessage> : TrueType {};
template <>
struct HasHeader<ObjectsMessage> : TrueType {};
template <>
struct MD5Sum<ObjectsMessage> {
  static const char* value(const ObjectsMessage& /*message*/) { return MD5Sum<ObjectStates>::value(); }
};
template <>
struct DataType<ObjectsMessage> {
  static const char* value(const ObjectsMessage& /*message*/) { return DataType<ObjectStates>::value(); }
};

}  // namespace ros::message_traits

namespace ros::serialization {

template <>
inline SerializedMessage serializeMessage(const spring_workbench::manipulation::ObjectsMessage& message) {
  return message.serialised();
}

}  // namespace ros::serialization
