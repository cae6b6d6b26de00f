#include "spring_workbench/motion/pose_predictor.h"

#include <algorithm>
#include <cmath>

#include "constants.h"
#include "spring_workbench/math/so3.h"
#include "spring_workbench/math/spatial.h"

namespace spring_workbench::motion {
namespace {

Vector6d displacement(const RigidTransform& from, const RigidTransform& to) {
  Vector6d d;
  d << to.translation() - from.translation(), math::turn_between(from, to);
  return d;
}

/// The weights, whose sum is 1, of the combination of predictions with the smallest variance.
template <int n>
Eigen::Matrix<double, n, 1> best_weights(Eigen::Matrix<double, n, n> covariance) {
  covariance.diagonal().array() += no_error * no_error;
  covariance.diagonal() *= 1.0 + shrinkage;
  const Eigen::Matrix<double, n, 1> weights = covariance.ldlt().solve(Eigen::Matrix<double, n, 1>::Ones());
  return weights / weights.sum();
}

}  // namespace

void PosePredictor::push(const PoseSample& sample) {
  if (!samples_.empty()) {
    compare(sample);
    interval_ = sample.t - samples_.back().t;
  }
  const std::size_t n = samples_.size();
  if (n > 1 && samples_[n - 1].t - samples_[n - 2].t < least_spacing) samples_.pop_back();
  samples_.push_back(sample);
  const double oldest = sample.t - forgotten * std::ldexp(shortest_fit, parabolas - 1);
  while (samples_.size() > 3 && samples_.front().t < oldest) samples_.pop_front();
  if (samples_.size() < 2) return;
  std::vector<Earlier> past;
  for (std::size_t i = samples_.size() - 1; i-- > 0;) {
    past.push_back({sample.t - samples_[i].t, displacement(sample.X, samples_[i].X)});
  }
  Prediction prediction{sample, {}};
  for (int i = 0; i < parabolas; ++i) {
    prediction.of_model[static_cast<std::size_t>(i) + 1] = fit(past, std::ldexp(shortest_fit, i));
  }
  mean_ = mean(prediction);
  if (samples_.size() > 2) predictions_.push_back(prediction);  // of two samples, they are lines
}

void PosePredictor::compare(const PoseSample& sample) {
  const double forget = std::exp((samples_.back().t - sample.t) / error_memory);
  positions_ *= forget;
  rotations_ *= forget;
  while (predictions_.size() > 1 && predictions_[1].newest.t <= sample.t - compared_ahead) predictions_.pop_front();
  if (predictions_.empty()) return;
  const Prediction& old = predictions_.front();
  const Vector6d moved = displacement(old.newest.X, sample.X);
  Eigen::Matrix<double, models, 6> errors;
  for (std::size_t i = 0; i < models; ++i) {
    errors.row(static_cast<Eigen::Index>(i)) = old.of_model[i].at(sample.t - old.newest.t) - moved;
  }
  positions_ += errors.leftCols<3>() * errors.leftCols<3>().transpose();
  rotations_ += errors.rightCols<3>() * errors.rightCols<3>().transpose();
}

/// The parabola that fits the newest sample and the earlier ones best if the weight of their squared distance decays
/// with their age; a line if there are two.
PosePredictor::Parabola PosePredictor::fit(const std::vector<Earlier>& past, double forgetting_time) {
  const double scale = std::max(forgetting_time, least_intervals * past.front().age);
  Matrix3d squares = Vector3d::UnitX().asDiagonal();  // of the newest sample, whose displacement is zero
  Eigen::Matrix<double, 3, 6> products = Eigen::Matrix<double, 3, 6>::Zero();
  for (std::size_t i = 0; i < past.size(); ++i) {
    const double u = -past[i].age / scale;
    if (i >= 2 && u < -forgotten) break;
    const Vector3d powers(1.0, u, u * u);
    const Vector3d weighted = std::exp(u) * powers;
    squares += weighted * powers.transpose();
    products += weighted * past[i].moved.transpose();
  }
  Eigen::Matrix<double, 3, 6> c = Eigen::Matrix<double, 3, 6>::Zero();
  if (past.size() >= 2) {
    c = squares.ldlt().solve(products);
  } else {
    c.topRows<2>() = squares.topLeftCorner<2, 2>().ldlt().solve(products.topRows<2>());
  }
  return {{c.row(0), c.row(1) / scale, c.row(2) / (scale * scale)}};
}

PosePredictor::Parabola PosePredictor::mean(const Prediction& prediction) const {
  const auto position_weights = best_weights<models>(positions_);
  const auto rotation_weights = best_weights<models>(rotations_);
  Parabola mean;
  for (std::size_t i = 0; i < models; ++i) {
    const auto row = static_cast<Eigen::Index>(i);
    for (std::size_t power = 0; power < 3; ++power) {
      const Vector6d& c = prediction.of_model[i].c[power];
      mean.c[power].head<3>() += position_weights[row] * c.head<3>();
      mean.c[power].tail<3>() += rotation_weights[row] * c.tail<3>();
    }
  }
  return mean;
}

std::optional<PoseSample> PosePredictor::predict(double t) const {
  if (samples_.size() < 2 || !(t > samples_.back().t)) return std::nullopt;
  return at(std::min(t, samples_.back().t + farthest));
}

std::vector<PoseSample> PosePredictor::continuation(double t) const {
  if (samples_.size() < 2) return {};
  const double newest = samples_.back().t;
  const double interval = std::min(interval_, farthest / 3.0);
  const double last = std::max(std::min(t, newest + farthest - interval), newest + 2.0 * interval);
  // A track that goes on to `t` ends there, and not at a sample that a rounding error puts before it.
  const auto exact = [t](double s) { return std::abs(s - t) < shortest_interval ? t : s; };
  return {at(exact(newest + interval)), at(exact(last)), at(last + interval)};
}

PoseSample PosePredictor::at(double t) const {
  const PoseSample& newest = samples_.back();
  const Vector6d change = mean_.at(t - newest.t);
  PoseSample predicted{t, newest.X};
  predicted.X.translation() += change.head<3>();
  predicted.X.linear() =
      Quaterniond(newest.X.linear() * math::exp_so3(Vector3d(change.tail<3>()))).normalized().toRotationMatrix();
  return predicted;
}

}  // namespace spring_workbench::motion
