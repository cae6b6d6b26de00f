#pragma once

#include <ros/time.h>

#include <optional>

namespace spring_workbench::ros_common {

/// Jumps back of a simulated clock, as a bag that is played again makes them. The clock and its streams come by ways of
/// their own, and what was sent before the jump may come after it.
class SimulatedClock {
 public:
  /// [s] a clock that is set back by less goes on. Less: a clock that is set right starts the scene anew. Test:
  /// manipulation_test.py::test_starts_anew_when_time_jumps_back.
  static constexpr double slip = 0.1;
  struct Stream {
    ros::Time newest;  ///< stamp, of this epoch; zero before the first message
  };

  /// The time now, for a message with this stamp of this stream; nothing when it belongs to the time after a jump back
  /// for which it has to wait. A stamp that goes on where its stream was, within `max_age` [s] of what the clock said
  /// then, belongs to the time before.
  std::optional<ros::Time> moment_of(const ros::Time& stamp, const Stream& stream, double max_age);
  /// Whether the other stream may still follow a jump back.
  bool is_patient() const;
  /// The jump is made. By how much the clock went back [s].
  double restart();

 private:
  ros::Time last_now_;
  bool jumped_ = false;     ///< it went back, and the streams have not both followed yet
  double jumped_at_ = 0.0;  ///< when that was noticed, in attended time [s]
};

}  // namespace spring_workbench::ros_common
