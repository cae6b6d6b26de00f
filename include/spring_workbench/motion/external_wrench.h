#pragma once

#include <deque>
#include <optional>

#include "spring_workbench/math/state_archive.h"
#include "spring_workbench/motion/stylus_source.h"

namespace spring_workbench::motion {

/// The wrench of a sensor over time: each sample acts from its time on until the next one, but no longer than
/// `timeout`: then it is zero (the watchdog).
class WrenchTrack {
 public:
  /// `timeout` [s] > 0.
  explicit WrenchTrack(double timeout) : timeout_(timeout) {}

  /// Adds a sample, which replaces those at the same or a later time that do not act yet. Throws as validate().
  void push(const ExternalWrench& sample);
  /// Goes to time `now` [s]; stamps `same_time` [s] apart are one. Returns whether the sample that acted has timed out.
  bool follow(double now, double same_time);
  /// The time after `now` at which the wrench changes; infinity where there is none.
  double next_edge(double now, double same_time) const;
  /// The wrench at the time of the last follow(); none if it is zero.
  const std::optional<ExternalWrench>& present() const { return present_; }
  void clear();

  void exchange(math::StateArchive& state) { state(next_, present_); }

 private:
  double timeout_;
  std::deque<ExternalWrench> next_;
  std::optional<ExternalWrench> present_;
};

}  // namespace spring_workbench::motion
