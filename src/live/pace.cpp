#include "spring_workbench/live/pace.h"

#include "constants.h"

namespace spring_workbench::live {

void Pace::committed(double simulated, double took, double lag) {
  if (!(simulated > 0.0)) return;
  const double cost = took / simulated;
  cost_ = cost_ > 0.0 ? cost_ + new_cost_weight * (cost - cost_) : cost;
  behind_ |= lag > longest_lag && work(lag) > longest_lag;
}

bool Pace::can_look_ahead(double time) const { return work(time) <= longest_look_ahead; }

}  // namespace spring_workbench::live
