#include "spring_workbench/hand_input/dead_band.h"

#include <cmath>

#include "constants.h"
#include "spring_workbench/math/so3.h"

namespace spring_workbench::hand_input {
namespace {

/// Fraction of a path of this length that must be covered so that only `play` is left.
double dragged_share(double length, double play) { return length > play ? 1.0 - play / length : 0.0; }

}  // namespace

bool DeadBand::within_band(const RigidTransform& X, const RigidTransform& of) const {
  const double distance = settings_.dead_band_distance, angle = settings_.dead_band_angle;
  return (distance == 0.0 || (X.translation() - of.translation()).norm() <= distance) &&
         (angle == 0.0 || math::turn_between(of, X).norm() <= angle);
}

void DeadBand::drag(const RigidTransform& X) {
  RigidTransform& followed = followed_->X;
  const Vector3d path = X.translation() - followed.translation(), turn = math::turn_between(followed, X);
  followed.translation() += dragged_share(path.norm(), play_ * settings_.dead_band_distance) * path;
  const double share = dragged_share(turn.norm(), play_ * settings_.dead_band_angle);
  const Matrix3d R = followed.linear() * math::exp_so3(share * turn);
  followed.linear() = Quaterniond(R).normalized().toRotationMatrix();  // so that rounding errors do not accumulate
}

motion::PoseSample DeadBand::filter(const motion::PoseSample& sample) {
  if (settings_.dead_band_distance == 0.0 && settings_.dead_band_angle == 0.0) return sample;
  if (!followed_) {
    followed_ = still_ = sample;
    rests_ = false;
    play_ = 0.0;
    return sample;
  }
  if (!within_band(sample.X, still_.X)) still_ = sample;
  if (!within_band(sample.X, followed_->X)) rests_ = false;
  if (!rests_) {
    play_ *= std::exp(-(sample.t - followed_->t) / tail_time);
    drag(sample.X);
    rests_ = sample.t - still_.t >= still_time && within_band(sample.X, followed_->X);
    if (rests_) play_ = 1.0;
  }
  if (settings_.dead_band_distance == 0.0) followed_->X.translation() = sample.X.translation();
  if (settings_.dead_band_angle == 0.0) followed_->X.linear() = sample.X.linear();
  followed_->t = sample.t;
  return *followed_;
}

}  // namespace spring_workbench::hand_input
