#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

namespace spring_workbench::live {

/// Converts each hand's times, which count from that hand's own epoch, to simulation time, which counts from the epoch
/// of the first hand.
class HandTimes {
 public:
  /// `hands`: number of hands; `simulated_time`: whether the clock is simulated. If so, a hand whose epoch is clearly
  /// before the current simulation time belongs to another run and does not join; on the wall clock every hand joins.
  HandTimes(std::size_t hands, bool simulated_time) : simulated_time_(simulated_time), shifts_(hands) {}

  /// Returns whether a hand whose epoch is `zero` [ns] joins the other hands at simulation time `t` [s]; false means
  /// that time has jumped.
  bool joins(std::size_t hand, std::int64_t zero, double t) const;
  void join(std::size_t hand, std::int64_t zero) { shifts_.at(hand) = 1e-9 * static_cast<double>(zero - zero_); }
  /// Restarts simulation time with this hand, whose epoch is `zero` [ns]; the other hands have to join again.
  void begin(std::size_t hand, std::int64_t zero);
  /// Returns whether this hand has joined.
  bool knows(std::size_t hand) const { return shifts_.at(hand).has_value(); }
  /// Converts a hand's time `t` [s] to simulation time [s].
  double time_of(std::size_t hand, double t) const { return t + shifts_.at(hand).value_or(0.0); }
  /// Skips `seconds` [s] of all hands' time; this time is not simulated.
  void skip(double seconds);
  /// Returns the time skipped since the last call [s].
  double take_skipped() { return std::exchange(skipped_, 0.0); }
  /// Converts a stamp [ns] to simulation time [s].
  double time_of_stamp(std::int64_t stamp) const { return 1e-9 * static_cast<double>(stamp - zero_); }
  /// Converts simulation time `t` [s] to a stamp [ns].
  std::int64_t stamp_of(double t) const { return zero_ + std::llround(1e9 * t); }

 private:
  bool simulated_time_;
  double skipped_ = 0.0;                       ///< [s]
  std::int64_t zero_ = 0;                      ///< epoch of simulation time [ns]
  std::vector<std::optional<double>> shifts_;  ///< to add to a hand's times [s]; none: it has not joined
};

}  // namespace spring_workbench::live
