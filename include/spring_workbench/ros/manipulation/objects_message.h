#pragma once

#include <ros/message_traits.h>
#include <ros/serialization.h>

#include <cstdint>
#include <cstring>
#include <vector>

#include "spring_workbench/ObjectStates.h"
#include "spring_workbench/live/shared_states.h"

namespace spring_workbench::manipulation {

/// An ObjectStates message, its objects in the bytes that go over the line. They are kept from one message to the next,
/// and only those of objects that have changed are written again.
class ObjectsMessage {
 public:
  std_msgs::Header header;

  void write(const live::SharedStates& objects);
  /// Of the field `objects`.
  const std::vector<std::uint8_t>& bytes() const { return bytes_; }

 private:
  live::SharedStates written_;
  std::vector<std::uint8_t> bytes_;
  std::vector<std::size_t> ends_;  ///< of the parts' bytes
};

}  // namespace spring_workbench::manipulation

// For roscpp it is an ObjectStates.
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
struct Serializer<spring_workbench::manipulation::ObjectsMessage> {
  using ObjectsMessage = spring_workbench::manipulation::ObjectsMessage;
  template <typename Stream>
  static void write(Stream& stream, const ObjectsMessage& message) {
    stream.next(message.header);
    const std::vector<std::uint8_t>& bytes = message.bytes();
    std::memcpy(stream.advance(static_cast<std::uint32_t>(bytes.size())), bytes.data(), bytes.size());
  }
  static std::uint32_t serializedLength(const ObjectsMessage& message) {
    return serializationLength(message.header) + static_cast<std::uint32_t>(message.bytes().size());
  }
};

}  // namespace ros::serialization
