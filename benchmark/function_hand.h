#pragma once

#include "benchmark/scenarios.h"
#include "spring_workbench/motion/motion_segment.h"

namespace spring_workbench::benchmark {

/// The handle of a scene as a function of time, for general methods on the library's equation of motion.
class FunctionHand final : public motion::FrameMotion {
 public:
  explicit FunctionHand(const Scenario& scene) : scene_(scene) {}

  motion::OwnAxesMotion in_own_axes(double t) const override;
  motion::FrameForcing<math::Pack> forcing(const math::Pack& t, double gravity) const override;

 private:
  const Scenario& scene_;
};

}  // namespace spring_workbench::benchmark
