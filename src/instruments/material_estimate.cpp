#include "spring_workbench/instruments/material_estimate.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "constants.h"
#include "spring_workbench/math/student_t.h"

namespace spring_workbench::instruments {
namespace {

/// First-order low-pass of a force that is linear between samples, with its derivative with respect to the time
/// constant [s].
class LowPass {
 public:
  LowPass(double lag, double force) : lag_(lag), force_(force), value_(force) {}

  void step(double h, double force) {
    const double rate = (force - force_) / h;
    if (lag_ > 0.0) {
      // T y' = F − y with F = force_ + rate s, solved exactly, and its derivative with respect to T.
      const double e = std::exp(-h / lag_), off = value_ - force_ + rate * lag_;
      slope_ = e * slope_ - rate * (1.0 - e) + off * (h / lag_) * e / lag_;
      value_ = force - rate * lag_ + off * e;
    } else {
      value_ = force;
      slope_ = -rate;
    }
    force_ = force;
  }
  double value() const { return value_; }
  double slope() const { return slope_; }

 private:
  double lag_, force_, value_, slope_ = 0.0;
};

/// Reciprocal of an estimate of a number > 0.
Estimate inverse(double value, double deviation) {
  constexpr double infinite = std::numeric_limits<double>::infinity();
  const auto of = [](double x) { return x > 0.0 ? 1.0 / x : infinite; };
  return {of(value), of(value + deviation), of(value - deviation)};
}

}  // namespace

void MaterialEstimate::add(double t, double path, double force) {
  samples_.push_back({t, path, force});
  if (samples_.size() > touch_samples) samples_.pop_front();
}

/// Least-squares fit of path = surface + compliance · (y + (T − lag) dy/dT) + start · exp(−(t − t₀) / lag), which is
/// linear in surface, compliance, the product of compliance and T, and in the decaying transient from before the first
/// sample (an impact, or dropped samples).
std::optional<MaterialEstimate::Fit> MaterialEstimate::fit_near(double lag) const {
  const auto count = static_cast<Eigen::Index>(samples_.size());
  constexpr Eigen::Index unknowns = 4;
  if (count < unknowns + min_extra_samples) return std::nullopt;
  Eigen::MatrixX4d of(count, unknowns);
  Eigen::VectorXd path(count);
  LowPass low_pass(lag, samples_.front().force);
  for (Eigen::Index i = 0; i < count; ++i) {
    const Sample& sample = samples_[static_cast<std::size_t>(i)];
    if (i > 0) low_pass.step(sample.t - samples_[static_cast<std::size_t>(i - 1)].t, sample.force);
    const double since = sample.t - samples_.front().t, start = i > 0 ? std::exp(-since / lag) : 1.0;
    of.row(i) << 1.0, low_pass.value(), low_pass.slope(), start;
    path[i] = sample.path - samples_.front().path;
  }
  const Eigen::RowVector4d scale = of.colwise().norm();
  if (!(scale.minCoeff() > 0.0)) return std::nullopt;
  const Eigen::ColPivHouseholderQR<Eigen::MatrixX4d> qr(of * scale.cwiseInverse().asDiagonal());
  if (qr.rank() < unknowns) return std::nullopt;
  const Eigen::Vector4d scaled = qr.solve(path);
  const Eigen::Vector4d x = scaled.cwiseQuotient(scale.transpose());
  const double spare = static_cast<double>(count - unknowns);
  const double variance = (path - of * x).squaredNorm() / spare;
  const Eigen::Matrix4d R = qr.matrixR().topRows<unknowns>().triangularView<Eigen::Upper>();
  const Eigen::Matrix4d half = qr.colsPermutation() * Eigen::Matrix4d(R.inverse());
  const Eigen::Vector4d deviation = (std::sqrt(variance) * half.rowwise().norm()).cwiseQuotient(scale.transpose());
  Fit fit;
  fit.surface = x[0] + samples_.front().path;
  fit.compliance = x[1];
  fit.lag = lag + x[2] / x[1];
  fit.compliance_deviation = deviation[1];
  fit.lag_deviation = deviation[2] / std::abs(x[1]);
  fit.quantile = math::student_t_quantile(spare, 0.5 + 0.5 * confidence);
  return fit;
}

/// A time constant below 0, which can result from noise if there is no damping, is linearised about 0.
std::optional<MaterialEstimate::Fit> MaterialEstimate::fit() const {
  double lag = 0.0;
  for (int i = 0; i < max_refits; ++i) {
    const std::optional<Fit> fit = fit_near(lag);
    if (!fit || !(fit->compliance > 0.0)) return std::nullopt;
    const double next = std::max(fit->lag, 0.0);
    if (std::abs(next - lag) <= converged_change * fit->lag_deviation + min_lag_change) return fit;
    lag = next;
  }
  return std::nullopt;
}

std::optional<MaterialReading> MaterialEstimate::reading() const {
  const std::optional<Fit> fit = this->fit();
  if (!fit) return std::nullopt;
  MaterialReading reading;
  const double interval = fit->quantile * fit->compliance_deviation;
  reading.touch = inverse(fit->compliance, interval);
  const double of_material = fit->compliance - 1.0 / probe_stiffness_;
  const bool gives = of_material > rigid_compliance * fit->compliance;
  reading.material = inverse(gives ? of_material : 0.0, interval);
  reading.material_deviation = gives ? fit->compliance_deviation / (of_material * of_material) : 0.0;
  const double stiffness = reading.touch.value, around = fit->quantile * stiffness * fit->lag_deviation;
  const double damping = stiffness * fit->lag - probe_damping_;
  reading.damping = {damping, damping - around, damping + around};
  return reading;
}

std::vector<MaterialEstimate::CurvePoint> MaterialEstimate::curve() const {
  std::vector<CurvePoint> curve;
  const std::optional<Fit> fit = this->fit();
  if (!fit) return curve;
  for (const Sample& sample : samples_) curve.push_back({sample.path - fit->surface, sample.force});
  return curve;
}

}  // namespace spring_workbench::instruments
