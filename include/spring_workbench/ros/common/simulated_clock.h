#pragma once

#include <ros/time.h>

#include <optional>

namespace spring_workbench::ros_common {

/// Handles jumps back of a simulated clock, e.g. when a bag is played again. The clock and the streams come over
/// separate connections, so messages that were sent before a jump may arrive after it.
class SimulatedClock {
 public:
  /// [s] a step back of up to this is no jump. Less: a small correction of the clock restarts the scene. Test:
  /// manipulation_test.py::test_starts_anew_when_time_jumps_back.
  static constexpr double slip = 0.1;
  struct Stream {
    ros::Time newest;  ///< stamp, of this epoch; zero before the first message
  };

  /// Returns the present time for a message of `stream` with this stamp, or nothing if the message belongs to the time
  /// after a jump that has not been made yet, and has to wait. After a jump of the clock, a stamp that is later than
  /// its stream's newest and within `max_age` [s] of the clock's last time before the jump belongs to the time before
  /// it.
  std::optional<ros::Time> moment_of(const ros::Time& stamp, const Stream& stream, double max_age);
  /// Returns true as long as the other stream may still follow a jump back.
  bool is_patient() const;
  /// Makes the jump. Returns by how much the clock went back [s].
  double restart();

 private:
  ros::Time last_now_;
  bool jumped_ = false;     ///< it went back, and the streams have not both followed yet
  double jumped_at_ = 0.0;  ///< when that was noticed, in attended time [s]
};

}  // namespace spring_workbench::ros_common
