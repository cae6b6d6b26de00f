#include "spring_workbench/live/hand_times.h"

#include "constants.h"

namespace spring_workbench::live {

bool HandTimes::joins(std::size_t hand, std::int64_t zero, double t) const {
  const auto is_known = [](const std::optional<double>& shift) { return shift.has_value(); };
  if (!simulated_time_) return std::any_of(shifts_.begin(), shifts_.end(), is_known);
  return !knows(hand) && 1e-9 * static_cast<double>(zero - zero_) > t - joining_slip;
}

void HandTimes::begin(std::size_t hand, std::int64_t zero) {
  shifts_.assign(shifts_.size(), std::nullopt);
  zero_ = zero;
  shifts_.at(hand) = 0.0;
}

void HandTimes::skip(double seconds) {
  const std::int64_t gap = std::llround(1e9 * seconds);
  zero_ += gap;
  skipped_ += seconds;
  for (std::optional<double>& shift : shifts_) {
    if (shift) *shift -= 1e-9 * static_cast<double>(gap);
  }
}

}  // namespace spring_workbench::live
