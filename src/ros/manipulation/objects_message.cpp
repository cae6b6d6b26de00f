#include "spring_workbench/ros/manipulation/objects_message.h"

#include <algorithm>
#include <atomic>

#include "messages.h"

namespace spring_workbench::manipulation {
namespace {

using ros::serialization::OStream;
using ros::serialization::serializationLength;

std::uint32_t length_of(const live::SharedStates::Part& part) {
  ObjectState message;
  std::uint32_t length = 0;
  for (const bodies::BodyState& object : part) {
    message.name = object.name;
    length += serializationLength(message);
  }
  return length;
}

}  // namespace

void ObjectsMessage::write(const std_msgs::Header& header, const live::SharedStates& objects) {
  const Bytes& newest = kept_[newest_];
  newest_ = (newest_ + 1) % kept_.size();
  Bytes& oldest = kept_[newest_];
  if (oldest.all.use_count() > 1) {  // roscpp has not sent it yet
    oldest = newest;
    const std::vector<std::uint8_t>& all = *newest.all;
    const std::size_t body = newest.ends.front();  // roscpp may be writing into the header
    oldest.all = std::make_shared<std::vector<std::uint8_t>>(body);
    oldest.all->reserve(all.size());
    oldest.all->insert(oldest.all->end(), all.begin() + static_cast<std::ptrdiff_t>(body), all.end());
  }
  std::atomic_thread_fence(std::memory_order_acquire);  // synchronises with the thread that sent it
  oldest.write(header, objects);
}

ros::SerializedMessage ObjectsMessage::serialised() const {
  const std::shared_ptr<std::vector<std::uint8_t>>& all = kept_[newest_].all;
  ros::SerializedMessage message({all->data(), [all](const std::uint8_t*) {}}, all->size());
  message.message_start = all->data() + sizeof(std::uint32_t);
  return message;
}

void ObjectsMessage::Bytes::write(const std_msgs::Header& header, const live::SharedStates& objects) {
  const auto count = static_cast<std::uint32_t>(objects.size());
  const std::size_t parts = objects.parts().size();
  std::size_t begin = 2 * sizeof count + serializationLength(header);
  if (ends.empty() || ends.front() != begin) ends.assign(1, begin);
  all->resize(std::max(all->size(), begin));
  for (std::size_t part = 0; part < parts; ++part) {
    const bool known = part + 1 < ends.size();
    if (!known || !objects.shares(part, written)) {
      const std::uint32_t length = length_of(*objects.parts()[part]);
      if (!known || ends[part + 1] != begin + length) {  // names changed, so all following bytes move
        ends.resize(part + 1);
        ends.push_back(begin + length);
        all->resize(begin + length);
      }
      OStream stream(&(*all)[begin], length);
      for (const bodies::BodyState& object : *objects.parts()[part]) stream.next(to_message(object));
    }
    begin = ends[part + 1];
  }
  ends.resize(parts + 1);
  all->resize(begin);
  written = objects;
  OStream stream(all->data(), static_cast<std::uint32_t>(ends.front()));
  stream.next(static_cast<std::uint32_t>(all->size() - sizeof count));
  stream.next(header);
  stream.next(count);
}

}  // namespace spring_workbench::manipulation
