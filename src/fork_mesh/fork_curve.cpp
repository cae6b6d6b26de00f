#include "spring_workbench/fork_mesh/fork_curve.h"

#include <algorithm>
#include <cmath>

#include "constants.h"
#include "spring_workbench/math/so3.h"
#include "spring_workbench/validation/number_rule.h"

namespace spring_workbench::fork_mesh {
namespace {

/// Derivative per interval at station `i`, by fourth-order differences.
Vector3d rate_at(const std::vector<RigidTransform>& stations, std::size_t i) {
  static const double weights[5][5] = {{-25.0, 48.0, -36.0, 16.0, -3.0},
                                       {-3.0, -10.0, 18.0, -6.0, 1.0},
                                       {1.0, -8.0, 0.0, 8.0, -1.0},
                                       {-1.0, 6.0, -18.0, 10.0, 3.0},
                                       {3.0, -16.0, 36.0, -48.0, 25.0}};
  const std::size_t first = std::min(std::max(i, std::size_t{2}) - 2, stations.size() - 5);
  Vector3d sum = Vector3d::Zero();
  for (std::size_t k = 0; k < 5; ++k) sum += weights[i - first][k] * stations[first + k].translation();
  return sum / 12.0;
}

}  // namespace

ForkCurve::ForkCurve(std::vector<RigidTransform> stations) : stations_(std::move(stations)) {
  validation::check_number("fork curve", "stations", static_cast<double>(stations_.size()),
                           validation::between(5.0, 1e6));
  for (std::size_t i = 0; i < stations_.size(); ++i) {
    p_rates_.push_back(rate_at(stations_, i));
    if (i == 0) continue;
    turn_rates_.push_back(math::log_so3(stations_[i - 1].linear().transpose() * stations_[i].linear()));
  }
}

CurvePoint ForkCurve::at(double u) const {
  const auto intervals = static_cast<double>(turn_rates_.size());
  const double place = std::clamp(u, 0.0, 1.0) * intervals;
  const std::size_t i = std::min(static_cast<std::size_t>(place), turn_rates_.size() - 1);
  const double v = place - static_cast<double>(i), w = 1.0 - v;
  const RigidTransform& a = stations_[i];
  const RigidTransform& b = stations_[i + 1];
  const Vector3d step = b.translation() - a.translation();
  CurvePoint point;
  point.p = a.translation() + v * v * (3.0 - 2.0 * v) * step + v * w * (w * p_rates_[i] - v * p_rates_[i + 1]);
  point.p_rate =
      intervals * (6.0 * v * w * step + w * (1.0 - 3.0 * v) * p_rates_[i] + v * (3.0 * v - 2.0) * p_rates_[i + 1]);
  point.R = a.linear() * math::exp_so3(v * turn_rates_[i]);
  point.turn_rate = intervals * turn_rates_[i];
  return point;
}

ForkCurve rod_curve(const rod::ShapeModel& shape, const rod::StrainVector& q, const RigidTransform& X_WH) {
  std::vector<RigidTransform> stations;
  stations.reserve(fork_curve_stations);
  for (int i = 0; i < fork_curve_stations; ++i) {
    stations.push_back(X_WH * shape.section(q, shape.length() * i / (fork_curve_stations - 1)));
  }
  return ForkCurve(std::move(stations));
}

const std::vector<std::string>& fork_curve_names() {
  static const std::vector<std::string> names = {"rod", "bezier"};
  return names;
}

ForkCurve make_fork_curve(const std::string& name, const rod::ShapeModel& shape, const rod::StrainVector& q,
                          const RigidTransform& X_WH) {
  if (name == "rod") return rod_curve(shape, q, X_WH);
  if (name == "bezier") {
    const RigidTransform X_WE = X_WH * shape.section(q, shape.length());
    return bezier_curve(X_WH, X_WE, shape.length() + shape.extension(q), shape.torsion_angle(q));
  }
  validation::refuse("fork", "curve", name, "one of " + validation::join(fork_curve_names()));
}

}  // namespace spring_workbench::fork_mesh
