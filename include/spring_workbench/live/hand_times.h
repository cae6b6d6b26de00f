#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <utility>

#include "spring_workbench/simulation/simulation.h"

namespace spring_workbench::live {

/// How the hands' times, each counted from a zero of its own, are the simulation's, which are counted from that of the
/// hand that came first.
class HandTimes {
 public:
  /// `simulated_time`: a hand that begins long before the simulated time is of another time; else none ever is.
  explicit HandTimes(bool simulated_time) : simulated_time_(simulated_time) {}

  /// Whether a hand that begins at `zero` [ns] comes to the others that are under way, at simulated time `t` [s],
  /// rather than that all time has jumped.
  bool joins(std::size_t hand, std::int64_t zero, double t) const;
  void join(std::size_t hand, std::int64_t zero) { shifts_.at(hand) = 1e-9 * static_cast<double>(zero - zero_); }
  /// All begins anew with this hand.
  void begin(std::size_t hand, std::int64_t zero);
  /// Whether a hand's times are those of the present.
  bool knows(std::size_t hand) const { return shifts_.at(hand).has_value(); }
  /// A hand's time as the simulation's [s].
  double time_of(std::size_t hand, double t) const { return t + shifts_.at(hand).value_or(0.0); }
  /// So much of all hands' time [s] is not simulated.
  void leave_out(double seconds);
  /// What was left out since the last call [s].
  double take_left_out() { return std::exchange(left_out_, 0.0); }
  /// Stamp of a simulated time [ns].
  std::int64_t stamp_of(double t) const { return zero_ + std::llround(1e9 * t); }

 private:
  bool simulated_time_;
  double left_out_ = 0.0;                                                         ///< [s]
  std::int64_t zero_ = 0;                                                         ///< of the simulation's times [ns]
  std::array<std::optional<double>, simulation::Simulation::most_hands> shifts_;  ///< from a hand's times [s]
};

}  // namespace spring_workbench::live
