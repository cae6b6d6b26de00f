#include "spring_workbench/motion/head_motion.h"

#include "constants.h"

namespace spring_workbench::motion {

RigidTransform HeadMotion::update(double stamp, const RigidTransform& X_FH, double now, double latency) {
  if (stamp != stamp_) {
    // After a loss, or after the clock was set, earlier samples do not predict the motion.
    if (stamp < stamp_ || stamp > stamp_ + head_dropout) predictor_.restart();
    predictor_.push({stamp, X_FH});
    stamp_ = stamp;
    received_at_ = now;
  }
  const auto predicted = latency > 0.0 ? predictor_.predict(stamp + latency + (now - received_at_)) : std::nullopt;
  return predicted ? predicted->X : X_FH;
}

}  // namespace spring_workbench::motion
