#include "spring_workbench/ros/common/dropped_messages.h"

#include <algorithm>
#include <utility>

namespace spring_workbench::ros_common {

double DroppedMessages::observe(const ConnectionFigures& now) {
  total_.messages += static_cast<std::uint32_t>(now.messages - last_.messages);
  total_.bytes += static_cast<std::uint32_t>(now.bytes - last_.bytes);
  last_ = now;
  if (total_.messages > history_.back().messages) history_.push_back(total_);
  while (history_.size() > 1 && total_.messages - history_[1].messages > queue_) history_.pop_front();
  const std::int64_t ahead = now.written - static_cast<std::int64_t>(total_.bytes);
  most_ahead_ = std::max(most_ahead_, ahead);
  const std::int64_t waiting = now.blocked ? static_cast<std::int64_t>(total_.bytes - history_.front().bytes) : 0;
  const std::int64_t before = std::exchange(missing_, most_ahead_ - ahead - waiting);
  const std::int64_t more = std::min(before, missing_) - dropped_;
  if (more <= 0) return 0.0;
  dropped_ += more;
  return static_cast<double>(more) * static_cast<double>(total_.messages) / static_cast<double>(total_.bytes);
}

}  // namespace spring_workbench::ros_common
