#include "spring_workbench/live/pace.h"

#include <chrono>
#include <cmath>

#include "constants.h"

namespace spring_workbench::live {

double Pace::steady_seconds() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

void Pace::committed(double simulated, double took, double lag) {
  if (!(simulated > 0.0)) return;
  const double cost = took / simulated;
  cost_ = measured_ && cost_ > 0.0 ? cost_ + new_cost_weight * (cost - cost_) : cost;
  measured_ = true;
  behind_ |= lag > longest_lag && work(lag) > longest_lag;
}

bool Pace::can_look_ahead(double time) const { return measured_ && work(time) <= longest_look_ahead; }

double Pace::end_of_cycle(double begin, double stop, double step) const {
  if (!std::isfinite(begin) || (measured_ && work(stop - begin) <= longest_cycle)) return stop;
  const double steps = measured_ ? std::floor(longest_cycle / work(step)) : 1.0;
  return std::min(begin + std::max(steps, 1.0) * step, stop);
}

}  // namespace spring_workbench::live
