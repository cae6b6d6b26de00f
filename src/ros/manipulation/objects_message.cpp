#include "spring_workbench/ros/manipulation/objects_message.h"

#include <algorithm>

#include "messages.h"

namespace spring_workbench::manipulation {
namespace {

using ros::serialization::OStream;

std::uint32_t length_of(const live::SharedStates::Part& part) {
  ObjectState message;
  std::uint32_t length = 0;
  for (const bodies::BodyState& object : part) {
    message.name = object.name;
    length += ros::serialization::serializationLength(message);
  }
  return length;
}

void write_part(const live::SharedStates::Part& part, std::uint8_t* bytes, std::uint32_t length) {
  OStream stream(bytes, length);
  for (const bodies::BodyState& object : part) stream.next(to_message(object));
}

}  // namespace

void ObjectsMessage::write(const live::SharedStates& objects) {
  const auto count = static_cast<std::uint32_t>(objects.size());
  const std::size_t parts = objects.parts().size();
  std::size_t begin = sizeof count;
  bytes_.resize(std::max(bytes_.size(), begin));
  OStream(bytes_.data(), sizeof count).next(count);
  for (std::size_t part = 0; part < parts; ++part) {
    const bool known = part < ends_.size();
    if (!known || !objects.shares(part, written_)) {
      const std::uint32_t length = length_of(*objects.parts()[part]);
      if (!known || ends_[part] != begin + length) {  // other names: so all that follows is at another place
        ends_.resize(part);
        ends_.push_back(begin + length);
        bytes_.resize(begin + length);
      }
      write_part(*objects.parts()[part], &bytes_[begin], length);
    }
    begin = ends_[part];
  }
  ends_.resize(parts);
  bytes_.resize(begin);
  written_ = objects;
}

}  // namespace spring_workbench::manipulation
