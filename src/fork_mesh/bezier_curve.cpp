#include <algorithm>
#include <array>
#include <cmath>

#include "constants.h"
#include "spring_workbench/fork_mesh/fork_curve.h"
#include "spring_workbench/math/moving_frames.h"
#include "spring_workbench/math/quadrature.h"
#include "spring_workbench/math/so3.h"

namespace spring_workbench::fork_mesh {
namespace {

const math::GaussLegendre<8>& rule() {
  static const math::GaussLegendre<8> gauss;
  return gauss;
}

/// Cubic Bézier curve between two poses, tangent to their z axes, with control arms of length `arm`.
class Bezier {
 public:
  Bezier(const RigidTransform& begin, const RigidTransform& end, double arm)
      : points_{begin.translation(), begin * Vector3d(0.0, 0.0, arm), end * Vector3d(0.0, 0.0, -arm),
                end.translation()} {}

  Vector3d at(double t) const {
    const double s = 1.0 - t;
    return s * s * s * points_[0] + 3.0 * s * s * t * points_[1] + 3.0 * s * t * t * points_[2] +
           t * t * t * points_[3];
  }
  Vector3d rate(double t) const {
    const double s = 1.0 - t;
    return 3.0 * (s * s * (points_[1] - points_[0]) + 2.0 * s * t * (points_[2] - points_[1]) +
                  t * t * (points_[3] - points_[2]));
  }
  /// Arc length between two parameters [m].
  double length(double from, double to) const {
    double sum = 0.0;
    for (int i = 0; i < rule().nodes.size(); ++i) {
      sum += rule().weights[i] * rate(from + (to - from) * rule().nodes[i]).norm();
    }
    return (to - from) * sum;
  }
  double length() const {
    double sum = 0.0;
    for (int i = 0; i < bezier_segments; ++i)
      sum += length(static_cast<double>(i) / bezier_segments, (i + 1.0) / bezier_segments);
    return sum;
  }

 private:
  std::array<Vector3d, 4> points_;
};

/// Compensation of the length: finds the arm with which the curve is `arc_length` long by regula falsi (Illinois),
/// starting from a third of it, the exact value for a straight line.
double arm_for(const RigidTransform& begin, const RigidTransform& end, double arc_length) {
  const auto excess = [&](double arm) { return Bezier(begin, end, arm).length() - arc_length; };
  const double start = arc_length / 3.0, accuracy = 1e-13 * arc_length;
  double a = start, f_a = excess(a);
  if (std::abs(f_a) < accuracy) return start;
  double b = f_a > 0.0 ? 0.0 : 2.0 * arc_length;
  double f_b = excess(b);
  if (f_a * f_b > 0.0) return start;
  for (int i = 0; i < 60; ++i) {
    const double c = (a * f_b - b * f_a) / (f_b - f_a);
    const double f_c = excess(c);
    if (std::abs(f_c) < accuracy) return c;
    if (f_c * f_b < 0.0) {
      a = b;
      f_a = f_b;
    } else {
      f_a *= 0.5;
    }
    b = c;
    f_b = f_c;
  }
  return b;
}

/// The curve's parameters at evenly spaced arc lengths, without the first.
std::vector<double> even_parameters(const Bezier& curve) {
  std::array<double, bezier_segments + 1> until{};  // arc length up to each segment
  for (int i = 0; i < bezier_segments; ++i) {
    const auto k = static_cast<std::size_t>(i);
    until[k + 1] = until[k] + curve.length(static_cast<double>(i) / bezier_segments, (i + 1.0) / bezier_segments);
  }
  std::vector<double> parameters;
  for (int i = 1; i + 1 < fork_curve_stations; ++i) {
    const double s = until.back() * i / (fork_curve_stations - 1);
    const auto after = std::upper_bound(until.begin() + 1, until.end() - 1, s);
    const auto k = static_cast<double>(after - until.begin() - 1);
    const double from = k / bezier_segments, to = (k + 1.0) / bezier_segments, s_from = *(after - 1);
    double t = from + (to - from) * (s - s_from) / std::max(*after - s_from, 1e-300);
    for (int newton = 0; newton < 5; ++newton) {
      const double speed = curve.rate(t).norm();
      if (!(speed > 0.0)) break;
      t = std::clamp(t - (s_from + curve.length(from, t) - s) / speed, from, to);
    }
    parameters.push_back(t);
  }
  parameters.push_back(1.0);
  return parameters;
}

/// Turns each frame about its z axis by its share of the remaining twist at the tip; the end frames are the given
/// poses.
void spread_twist(const RigidTransform& X_WE, double twist, std::vector<RigidTransform>& stations) {
  const double missing = math::log_so3(stations.back().linear().transpose() * X_WE.linear()).z();
  const double whole = missing + 2.0 * M_PI * std::round((twist - missing) / (2.0 * M_PI));
  for (std::size_t i = 0; i < stations.size(); ++i) {
    const double share = static_cast<double>(i) / static_cast<double>(stations.size() - 1);
    stations[i].rotate(Eigen::AngleAxisd(share * whole, Vector3d::UnitZ()));
  }
  stations.back() = X_WE;
}

}  // namespace

ForkCurve bezier_curve(const RigidTransform& X_WH, const RigidTransform& X_WE, double arc_length, double twist) {
  const Bezier curve(X_WH, X_WE, arm_for(X_WH, X_WE, arc_length));
  std::vector<RigidTransform> stations{X_WH};
  stations.reserve(fork_curve_stations);
  for (const double t : even_parameters(curve)) {
    RigidTransform X = stations.back();
    X.translation() = curve.at(t);
    const Vector3d along = curve.rate(t);
    if (along.norm() > 0.0) X.linear() = math::shortest_rotation(X.linear().col(2), along) * X.linear();
    stations.push_back(X);
  }
  spread_twist(X_WE, twist, stations);
  return ForkCurve(std::move(stations));
}

}  // namespace spring_workbench::fork_mesh
