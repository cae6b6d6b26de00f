#include "spring_workbench/instruments/vibration.h"

#include <algorithm>
#include <cmath>

#include "constants.h"

namespace spring_workbench::instruments {

double Vibration::update_intensity(double t, const tools::ToolState& tool, double impulse) {
  const Instant now{t, tool.held_object, tool.tip_wrench_W.force};
  const bool continues = last_ && !now.held.empty() && now.held == last_->held && t >= last_->t;
  double felt = 0.0;
  if (continues && t > last_->t) {
    const double rate = (now.force - last_->force).norm() / (t - last_->t);
    felt = std::max(rate / full_jolt, impulse / full_strike) / tool.force_scale;
    intensity_ *= std::exp(-(t - last_->t) / vibration_time);
  }
  intensity_ = continues ? std::clamp(felt, intensity_, 1.0) : 0.0;
  if (intensity_ < min_vibration) intensity_ = 0.0;
  if (!continues || t > last_->t) last_ = now;
  return intensity_;
}

}  // namespace spring_workbench::instruments
