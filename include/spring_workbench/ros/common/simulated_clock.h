#pragma once

#include <ros/time.h>

#include <optional>

namespace spring_workbench::ros_common {

/// Handles jumps back of a simulated clock, e.g. when a bag is played again. The clock and the streams come over
/// separate connections, so messages that were sent before a jump may arrive after it.
class SimulatedClock {
 public:
  /// [s]; a smaller step back is not a jump. Smaller: a small correction of the clock restarts the scene. Test:
  /// manipulation_test.py::test_restarts_when_time_jumps_back.
  static constexpr double slip = 0.1;
  struct Stream {
    ros::Time newest;  ///< newest stamp of this epoch; zero before the first message
  };

  /// Returns the current time for a message of `stream` with this stamp, or nothing if the message was sent after a
  /// jump that has not been made yet, so that it has to wait. After a jump of the clock, a message counts as sent
  /// before the jump if its stamp is later than the newest of its stream and within `max_age` [s] of the clock's last
  /// time before the jump.
  std::optional<ros::Time> moment_of(const ros::Time& stamp, const Stream& stream, double max_age);
  /// Returns whether to keep waiting for the other stream to follow a jump back.
  bool is_waiting() const;
  /// Makes the jump. Returns by how much the clock went back [s].
  double restart();

 private:
  ros::Time last_now_;
  bool jumped_ = false;     ///< the clock jumped back, and the streams have not both followed yet
  double jumped_at_ = 0.0;  ///< when the jump was noticed, in running time [s]
};

}  // namespace spring_workbench::ros_common
