#include "spring_workbench/ros/common/simulated_clock.h"

#include <cmath>
#include <utility>

#include "constants.h"
#include "spring_workbench/ros/common/loop_clock.h"

namespace spring_workbench::ros_common {

std::optional<ros::Time> SimulatedClock::moment_of(const ros::Time& stamp, const Stream& stream, double max_age) {
  const ros::Time now = ros::Time::now();
  // The clock jumped back; or the jump was missed, and only the stamps show it.
  const bool clock_jumped = !last_now_.isZero() && (last_now_ - now).toSec() > slip;
  const bool stamps_jumped =
      !stream.newest.isZero() && (stream.newest - stamp).toSec() > slip && (stream.newest - now).toSec() > slip;
  if (!jumped_ && (clock_jumped || stamps_jumped)) {
    jumped_ = true;
    jumped_at_ = local_time().running;
  }
  if (!jumped_) last_now_ = now;
  const bool continues =
      !stream.newest.isZero() && stamp > stream.newest && std::abs((last_now_ - stamp).toSec()) < max_age;
  if (jumped_ && !continues) return std::nullopt;
  return last_now_;
}

bool SimulatedClock::is_waiting() const { return local_time().running - jumped_at_ < jump_timeout; }

double SimulatedClock::restart() {
  const ros::Time now = ros::Time::now();
  jumped_ = false;
  return (std::exchange(last_now_, now) - now).toSec();
}

}  // namespace spring_workbench::ros_common
