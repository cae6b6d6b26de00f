#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>

namespace spring_workbench::ros_common {

/// Figures of a connection to a subscriber, all of one instant.
struct ConnectionFigures {
  std::uint32_t messages = 0;  ///< put into the queue since the connection was made, modulo 2^32
  std::uint32_t bytes = 0;     ///< of these messages, modulo 2^32
  std::int64_t written = 0;    ///< bytes of them that the system has taken over
  bool blocked = false;        ///< whether the system takes no more at present, so that messages wait in the queue
};

/// Counts the messages that the full queue of a connection drops, from figures at several instants. What was put into
/// the queue and not written was dropped, unless it may still wait in the queue. So the count never exceeds the number
/// of dropped messages if all have the same size, and reaches it once the queue is empty. With different sizes a
/// dropped message counts as one of mean size.
class DroppedMessages {
 public:
  /// `queue`: the largest number of messages in the queue, > 0.
  explicit DroppedMessages(std::size_t queue) : queue_(queue) {}

  /// Returns the number of dropped messages that this instant adds to the count. What only one instant shows is not
  /// counted, because the queue may just be being emptied. Two instants must be less than 2^32 bytes apart.
  double observe(const ConnectionFigures& now);

 private:
  struct Total {
    std::uint64_t messages = 0, bytes = 0;
  };

  std::size_t queue_;
  ConnectionFigures last_;
  Total total_;
  /// Totals at earlier instants: the first has more than `queue` messages after it, or is the beginning. So the
  /// messages that may wait, with the one that is being written, are among those after it.
  std::deque<Total> history_{Total()};
  std::int64_t most_ahead_ = 0;  ///< largest `written` beyond the total so far: more than 0 only if it is inaccurate
  std::int64_t missing_ = 0;     ///< bytes neither written nor waiting, at last
  std::int64_t dropped_ = 0;     ///< bytes counted so far
};

}  // namespace spring_workbench::ros_common
