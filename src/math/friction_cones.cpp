#include "spring_workbench/math/friction_cones.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <limits>

#include "constants.h"

namespace spring_workbench::math {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::Vector3d;
using Eigen::VectorXd;

// Vectors [v0, v1, v2] of the cone v0 ≥ |(v1, v2)|, one after the other.

Vector3d mirrored(const Vector3d& v) { return {v[0], -v[1], -v[2]}; }

/// v0² − |(v1, v2)|²: zero on the cone.
double determinant(const Vector3d& v) {
  const double across = std::hypot(v[1], v[2]);
  return (v[0] - across) * (v[0] + across);
}

Vector3d product(const Vector3d& a, const Vector3d& b) {
  return {a.dot(b), a[0] * b[1] + b[0] * a[1], a[0] * b[2] + b[0] * a[2]};
}

/// The solution of product(a, ·) = b.
Vector3d quotient(const Vector3d& b, const Vector3d& a) {
  const double first = a.dot(mirrored(b)) / determinant(a);
  return {first, (b[1] - first * a[1]) / a[0], (b[2] - first * a[2]) / a[0]};
}

/// Largest multiple of `d` that can be added to `v` without leaving its cone.
double longest_step(const Vector3d& v, const Vector3d& d) {
  const double a = determinant(d), b = v.dot(mirrored(d)), c = determinant(v);
  const double over = std::sqrt(std::max(0.0, b * b - a * c)) - b;  // negative under the root: rounding
  return over > 0.0 ? c / over : std::numeric_limits<double>::infinity();
}

/// Nesterov and Todd's scaling: symmetric, W x = W⁻¹ y for an impulse x and a rate y.
struct Scaling {
  Eigen::Matrix3d W, inverse;
  Vector3d at;  ///< W x = W⁻¹ y
};

Scaling scaling(const Vector3d& x, const Vector3d& y) {
  const double size_x = std::sqrt(determinant(x)), size_y = std::sqrt(determinant(y));
  const Vector3d unit_x = x / size_x, unit_y = y / size_y;
  const Vector3d w = (unit_y + mirrored(unit_x)) / std::sqrt(2.0 * (1.0 + unit_x.dot(unit_y)));
  Eigen::Matrix3d M = Eigen::Matrix3d::Identity() + w * w.transpose() / (1.0 + w[0]);
  M.row(0) = w.transpose();
  M.col(0) = w;
  const double eta = std::sqrt(size_y / size_x);
  const Vector3d mirror(1.0, -1.0, -1.0);
  Scaling s{eta * M, mirror.asDiagonal() * M * mirror.asDiagonal() / eta, {}};
  s.at = s.W * x;
  return s;
}

/// The problem, scaled so that the slope of every cone, the response of every contact and the largest rate are 1.
class ScaledProblem {
 public:
  ScaledProblem(const MatrixXd& A, const VectorXd& b, const std::vector<double>& friction)
      : count_(static_cast<Index>(friction.size())), by_(b.size()) {
    VectorXd response(count_);  // of a contact, to an impulse in its cone
    for (Index i = 0; i < count_; ++i) {
      const double slope = std::max(friction[static_cast<std::size_t>(i)], min_friction);
      by_.segment<3>(3 * i) << slope, 1.0, 1.0;
      response[i] =
          std::sqrt(A.diagonal().segment<3>(3 * i).cwiseQuotient(by_.segment<3>(3 * i).cwiseAbs2()).sum() / 3.0);
    }
    const double least = min_response * response.maxCoeff();
    for (Index i = 0; i < count_; ++i) by_.segment<3>(3 * i) *= std::max(response[i], least);
    A_ = by_.cwiseInverse().asDiagonal() * A * by_.cwiseInverse().asDiagonal();
    b_ = b.cwiseQuotient(by_);
    largest_ = b_.cwiseAbs().maxCoeff();
    b_ /= largest_;
    x_ = y_ = VectorXd::Zero(b.size());
    for (Index i = 0; i < count_; ++i) x_[3 * i] = y_[3 * i] = 1.0;
  }

  bool possible() const { return largest_ > 0.0 && by_.allFinite() && by_.minCoeff() > 0.0; }

  /// Returns whether impulses and rates fulfil the law.
  bool solve() {
    double best = std::numeric_limits<double>::infinity();
    for (int i = 0; i < max_iterations; ++i) {
      const double gap = x_.dot(y_) / static_cast<double>(count_);
      const VectorXd missing = law() - y_;
      const double error = std::max(gap, missing.cwiseAbs().maxCoeff());
      if (!(error < std::numeric_limits<double>::infinity())) break;
      if (error < best) {
        best = error;
        solution_ = x_;
      }
      if (error < residual_tolerance || !iterate(gap, missing)) break;
    }
    return best < acceptable_residual;
  }

  VectorXd impulses() const { return largest_ * solution_.cwiseQuotient(by_); }

 private:
  Vector3d of(const VectorXd& v, Index i) const { return v.segment<3>(3 * i); }

  /// Returns the rates caused by the impulses, with the slip added to each normal rate (De Saxcé): Coulomb's law
  /// requires them to lie in the cone, too.
  VectorXd law() const {
    VectorXd y = A_ * x_ + b_;
    for (Index i = 0; i < count_; ++i) y[3 * i] += std::hypot(y[3 * i + 1], y[3 * i + 2]);
    return y;
  }

  double longest(const VectorXd& dx, const VectorXd& dy) const {
    double step = std::numeric_limits<double>::infinity();
    for (Index i = 0; i < count_; ++i) {
      step = std::min({step, longest_step(of(x_, i), of(dx, i)), longest_step(of(y_, i), of(dy, i))});
    }
    return step;
  }

  bool iterate(double gap, const VectorXd& missing) {
    std::vector<Scaling> scalings;
    MatrixXd K = A_;
    for (Index i = 0; i < count_; ++i) {
      if (!(determinant(of(x_, i)) > 0.0 && determinant(of(y_, i)) > 0.0)) return false;
      scalings.push_back(scaling(of(x_, i), of(y_, i)));
      K.block<3, 3>(3 * i, 3 * i) += scalings.back().W * scalings.back().W;
    }
    const Eigen::LLT<MatrixXd> factors(K);
    if (factors.info() != Eigen::Success) return false;
    VectorXd dx(x_.size()), dy(x_.size()), wanted(x_.size());
    const auto direction = [&](const auto& product_wanted) {
      for (Index i = 0; i < count_; ++i) {
        const Scaling& s = scalings[static_cast<std::size_t>(i)];
        wanted.segment<3>(3 * i) = s.W * quotient(product_wanted(s, i), s.at);
      }
      dx = factors.solve(wanted - missing);
      dy = A_ * dx + missing;
    };
    direction([](const Scaling& s, Index) -> Vector3d { return -product(s.at, s.at); });
    const double rest = 1.0 - std::min(1.0, longest(dx, dy));
    // No closer to the boundary of the cones than the error of the assumed slip: otherwise the iteration stalls there.
    const double centre =
        std::max(gap * rest * rest * rest, std::min(gap, min_centring * missing.cwiseAbs().maxCoeff()));
    const VectorXd towards_x = dx, towards_y = dy;
    direction([&](const Scaling& s, Index i) -> Vector3d {
      return centre * Vector3d::UnitX() - product(s.at, s.at) -
             product(s.W * of(towards_x, i), s.inverse * of(towards_y, i));
    });
    const double step = std::min(1.0, (1.0 - std::clamp(gap, 1e-3, 0.1)) * longest(dx, dy));
    x_ += step * dx;
    y_ += step * dy;
    return true;
  }

  Index count_;
  VectorXd by_;  ///< impulses are multiplied, rates divided by it
  MatrixXd A_;
  VectorXd b_, x_, y_, solution_;
  double largest_;
};

}  // namespace

bool solve_in_cones(const MatrixXd& A, const VectorXd& b, const std::vector<double>& friction, VectorXd& x) {
  if (friction.empty()) return false;
  ScaledProblem problem(A, b, friction);
  if (!problem.possible() || !problem.solve()) return false;
  x = problem.impulses();
  return true;
}

}  // namespace spring_workbench::math
