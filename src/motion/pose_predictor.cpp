#include "spring_workbench/motion/pose_predictor.h"

#include <algorithm>

#include "constants.h"
#include "spring_workbench/math/so3.h"
#include "spring_workbench/math/spatial.h"

namespace spring_workbench::motion {

void PosePredictor::push(const PoseSample& sample) {
  samples_.push_back(sample);
  // Keep one sample older than the window, for slow streams.
  while (samples_.size() > 2 && samples_[1].t < sample.t - parabola_window) samples_.pop_front();
}

std::optional<PoseSample> PosePredictor::predict(double t) const {
  if (samples_.empty() || !(t > samples_.back().t)) return std::nullopt;
  const PoseSample& newest = samples_.back();
  const double ahead = std::min(t - newest.t, farthest);
  // Least-squares fit of d = v s + a s² over the earlier samples, with s < 0 the time relative to the newest.
  double s_2 = 0.0, s_3 = 0.0, s_4 = 0.0;
  Vector6d d_1 = Vector6d::Zero(), d_2 = Vector6d::Zero();
  for (std::size_t i = samples_.size() - 1; i-- > 0;) {
    const double s = samples_[i].t - newest.t;
    if (s < -parabola_window && i + 2 < samples_.size()) break;  // always use the previous sample
    Vector6d d;
    d << samples_[i].X.translation() - newest.X.translation(), math::turn_between(newest.X, samples_[i].X);
    s_2 += s * s;
    s_3 += s * s * s;
    s_4 += s * s * s * s;
    d_1 += s * d;
    d_2 += s * s * d;
  }
  if (!(s_2 > 0.0)) return PoseSample{newest.t + ahead, newest.X};
  const double determinant = s_2 * s_4 - s_3 * s_3;
  const bool curved = samples_.size() > 3 && determinant > min_spread * s_2 * s_4;
  const Vector6d v = curved ? Vector6d((s_4 * d_1 - s_3 * d_2) / determinant) : Vector6d(d_1 / s_2);
  const Vector6d a = curved ? Vector6d((s_2 * d_2 - s_3 * d_1) / determinant) : Vector6d(Vector6d::Zero());
  const Vector6d change = ahead * v + (ahead * ahead) * a;
  RigidTransform X = newest.X;
  X.translation() += change.head<3>();
  X.linear() = Quaterniond(X.linear() * math::exp_so3(Vector3d(change.tail<3>()))).normalized().toRotationMatrix();
  return PoseSample{newest.t + ahead, X};
}

}  // namespace spring_workbench::motion
