#pragma once

#include <deque>
#include <optional>

#include "spring_workbench/math/state_archive.h"
#include "spring_workbench/motion/stylus_source.h"

namespace spring_workbench::motion {

/// The wrench of a sensor over time. Each sample acts from its time until the next one, but for at most `timeout`; then
/// the wrench is zero (watchdog).
class WrenchTrack {
 public:
  /// `timeout` [s] > 0.
  explicit WrenchTrack(double timeout) : timeout_(timeout) {}

  /// Adds a sample. It replaces pending samples at the same or a later time. Throws like validate().
  void push(const ExternalWrench& sample);
  /// Moves to time `now` [s]; stamps within `same_time` [s] of each other count as equal. Returns whether the acting
  /// sample has timed out.
  bool advance_to(double now, double same_time);
  /// The next time after `now` at which the wrench changes [s]; infinity if there is none.
  double next_change_time(double now, double same_time) const;
  /// The wrench at the time of the last advance_to(); none if it is zero.
  const std::optional<ExternalWrench>& present() const { return present_; }
  void clear();

  void archive(math::StateArchive& state) { state(next_, present_); }

 private:
  double timeout_;
  std::deque<ExternalWrench> next_;
  std::optional<ExternalWrench> present_;
};

}  // namespace spring_workbench::motion
