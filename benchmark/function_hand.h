#pragma once

#include "benchmark/scenarios.h"
#include "spring_workbench/motion/motion_segment.h"

namespace spring_workbench::benchmark {

/// The handle of a scene as a function of time, for general methods on the library's equation of motion.
class FunctionHand final : public motion::Trajectory {
 public:
  explicit FunctionHand(const Scenario& scene) : scene_(scene) {}

  motion::BodyRateState body_rate_state(double t) const override;
  motion::BodyFrameRates<math::Pack> body_frame_rates(const math::Pack& t, double gravity) const override;

 private:
  const Scenario& scene_;
};

}  // namespace spring_workbench::benchmark
