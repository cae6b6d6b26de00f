#include "spring_workbench/hand_input/pose_filter.h"

#include <cmath>

#include "constants.h"
#include "spring_workbench/math/so3.h"

namespace spring_workbench::hand_input {
namespace {

/// Weight of the new value in a first-order low-pass with this cut-off [Hz], for an interval dt [s].
double weight(double cutoff, double dt) {
  const double u = 2.0 * M_PI * cutoff * dt;
  return u / (1.0 + u);
}

}  // namespace

motion::PoseSample PoseFilter::filter(const motion::PoseSample& sample) {
  if (!(settings_.min_cutoff > 0.0)) return sample;
  if (!running_) {
    running_ = true;
    raw_ = sample;
    X_ = sample.X;
    v_ = w_B_ = Vector3d::Zero();
    return sample;
  }
  const double dt = sample.t - raw_.t;
  const double a = weight(velocity_cutoff, dt);
  v_ += a * ((sample.X.translation() - raw_.X.translation()) / dt - v_);
  w_B_ += a * (math::log_so3(raw_.X.linear().transpose() * sample.X.linear()) / dt - w_B_);
  raw_ = sample;
  const double p_share = weight(settings_.min_cutoff + settings_.beta * v_.norm(), dt);
  const double R_share = weight(settings_.min_cutoff + settings_.beta_angle * w_B_.norm(), dt);
  X_.translation() += p_share * (sample.X.translation() - X_.translation());
  const Matrix3d R = X_.linear() * math::exp_so3(R_share * math::log_so3(X_.linear().transpose() * sample.X.linear()));
  X_.linear() = Quaterniond(R).normalized().toRotationMatrix();  // so that rounding errors do not accumulate
  return {sample.t, X_};
}

}  // namespace spring_workbench::hand_input
