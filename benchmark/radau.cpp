#include <Eigen/Core>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>
#include <stdexcept>
#include <utility>

#include "benchmark/adaptive_solver.h"

namespace spring_workbench::benchmark {
namespace {

constexpr int kMaxEquations = AdaptiveSolver::max_equations;
constexpr int kMaxIterations = 6;  // of Newton's method
using Complex = std::complex<double>;
using State = AdaptiveSolver::State;
using ComplexState = Eigen::Matrix<Complex, Eigen::Dynamic, 1, 0, kMaxEquations, 1>;
using Jacobian = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, kMaxEquations, kMaxEquations>;
using ComplexMatrix = Eigen::Matrix<Complex, Eigen::Dynamic, Eigen::Dynamic, 0, kMaxEquations, kMaxEquations>;
using Stages = Eigen::Matrix<double, Eigen::Dynamic, 3, 0, kMaxEquations, 3>;

const double kRoot6 = std::sqrt(6.0), kThird = std::cbrt(3.0);
const Eigen::Vector3d kNodes((4.0 - kRoot6) / 10.0, (4.0 + kRoot6) / 10.0, 1.0);
const Eigen::Vector3d kError((-13.0 - 7.0 * kRoot6) / 3.0, (-13.0 + 7.0 * kRoot6) / 3.0, -1.0 / 3.0);
/// Eigenvalues of the inverse of the method's matrix, and the transformation that block-diagonalises it.
const double kReal = 3.0 + kThird * kThird - kThird;
const Complex kComplex(3.0 + 0.5 * (kThird - kThird * kThird),
                       -0.5 * (std::pow(3.0, 5.0 / 6.0) + std::pow(3.0, 7.0 / 6.0)));
const Eigen::Matrix3d kT = (Eigen::Matrix3d() << 0.09443876248897524, -0.14125529502095421, 0.03002919410514742,
                            0.25021312296533332, 0.20412935229379994, -0.38294211275726192, 1.0, 1.0, 0.0)
                               .finished();
const Eigen::Matrix3d kInverseT = kT.inverse();
/// Converts the stages to the coefficients of the collocation polynomial.
const Eigen::Matrix3d kRadauDense =
    (Eigen::Matrix3d() << 13.0 / 3.0 + 7.0 * kRoot6 / 3.0, -23.0 / 3.0 - 22.0 * kRoot6 / 3.0, 10.0 / 3.0 + 5.0 * kRoot6,
     13.0 / 3.0 - 7.0 * kRoot6 / 3.0, -23.0 / 3.0 + 22.0 * kRoot6 / 3.0, 10.0 / 3.0 - 5.0 * kRoot6, 1.0 / 3.0,
     -8.0 / 3.0, 10.0 / 3.0)
        .finished();

class Radau final : public AdaptiveSolver {
 public:
  Radau(int size, Rates rates) : rates_(std::move(rates)), size_(size) {}

  void begin(double t, const std::vector<double>& y, double tolerance, const std::vector<double>& scale) override {
    set_start(t, y, tolerance, scale);
    newton_tolerance_ =
        std::max(10.0 * std::numeric_limits<double>::epsilon() / tolerance, std::min(0.03, std::sqrt(tolerance)));
    jacobian_known_ = factored_ = stepped_ = false;
    convergence_ = 1.0;
  }

 private:
  bool evaluate(double t, const State& y, State& f) const {
    f.resize(size_);
    return rates_(t, y.data(), f.data()) && f.allFinite();
  }
  State polynomial(double share) const { return dense_ * Eigen::Vector3d(share, share * share, share * share * share); }

  void find_jacobian() {
    jacobian_.resize(size_, size_);
    State y = y_, f;
    for (int i = 0; i < size_; ++i) {
      const double d = 1.5e-8 * std::max(std::abs(y_[i]), absolute_[i] / tolerance_);
      y[i] = y_[i] + d;
      if (!evaluate(t_, y, f)) throw std::runtime_error("Radau: no rates for the Jacobian");
      jacobian_.col(i) = (f - f_) / d;
      y[i] = y_[i];
    }
    jacobian_known_ = true;
    factored_ = false;
  }

  void factor(double h) {
    if (factored_ && h == factored_for_) return;
    real_.compute(kReal / h * Jacobian::Identity(size_, size_) - jacobian_);
    complex_.compute(kComplex / h * ComplexMatrix::Identity(size_, size_) - jacobian_.cast<Complex>());
    factored_ = true;
    factored_for_ = h;
  }

  /// Newton's method for the stages minus the start; returns false if it does not converge. It may end after one
  /// iteration if the last step's converged fast.
  bool solve_stages(double h, Stages& z) {
    const State scale = absolute_ + tolerance_ * y_.cwiseAbs();
    Stages w = z * kInverseT.transpose(), f(size_, 3);
    double last = -1.0;
    convergence_ = std::pow(std::max(convergence_, std::numeric_limits<double>::epsilon()), 0.8);
    State at;
    for (iterations_ = 1; iterations_ <= kMaxIterations; ++iterations_) {
      for (int i = 0; i < 3; ++i) {
        if (!evaluate(t_ + kNodes[i] * h, y_ + z.col(i), at)) return false;
        f.col(i) = at;
      }
      const Stages g = f * kInverseT.transpose();
      const State real = real_.solve(State(g.col(0) - kReal / h * w.col(0)));
      ComplexState right(size_);
      for (int i = 0; i < size_; ++i) right[i] = Complex(g(i, 1), g(i, 2)) - kComplex / h * Complex(w(i, 1), w(i, 2));
      const ComplexState both = complex_.solve(right);
      Stages change(size_, 3);
      change << real, both.real(), both.imag();
      double size = 0.0;
      for (int i = 0; i < 3; ++i) size += change.col(i).cwiseQuotient(scale).squaredNorm();
      size = std::sqrt(size / (3.0 * size_));
      rate_ = last > 0.0 ? size / last : 0.0;
      if (last > 0.0 && (rate_ >= 1.0 || std::pow(rate_, kMaxIterations - iterations_ + 1) / (1.0 - rate_) * size >
                                             newton_tolerance_)) {
        return false;
      }
      if (last > 0.0) convergence_ = rate_ / (1.0 - rate_);
      w += change;
      z = w * kT.transpose();
      if (convergence_ * size < newton_tolerance_) return true;
      last = size;
    }
    return false;
  }

  double factor_for(double h, double error) const {
    const double e = std::max(error, 1e-30);
    const double before = stepped_ && last_error_ > 0.0 ? h / last_h_ * std::pow(last_error_ / e, 0.25) : 1.0;
    return std::min(1.0, before) * std::pow(e, -0.25);
  }

  State within_last_step(double share) override { return from_ + polynomial(share); }

  void step(double longest) override {
    if (!rates_known_ && !evaluate(t_, y_, f_)) throw std::runtime_error("Radau: no rates at the start of a step");
    rates_known_ = true;
    const State scale = absolute_ + tolerance_ * y_.cwiseAbs();
    if (h_ == 0.0) h_ = std::min(1e-4, std::pow(0.01 / std::max(norm(f_, scale), 1e-12), 0.25));
    bool rejected = false;
    while (true) {
      if (!(h_ > 1e-14 * std::max(1.0, std::abs(t_)))) throw std::runtime_error("Radau: the step has become too small");
      // Equal steps up to a stop, so that the factorisation stays valid.
      const double h = std::isfinite(longest) ? longest / std::ceil(longest / h_ * (1.0 - 1e-9)) : h_;
      bool fresh = false, converged = false;
      Stages z(size_, 3);
      while (!converged) {
        if (!jacobian_known_) {
          find_jacobian();
          fresh = true;
        }
        factor(h);
        z.setZero();
        if (stepped_) {
          for (int i = 0; i < 3; ++i) z.col(i) = within_last_step((t_ + kNodes[i] * h - before_) / (t_ - before_)) - y_;
        }
        converged = solve_stages(h, z);
        if (!converged && fresh) break;
        jacobian_known_ = converged;
      }
      if (!converged) {
        h_ = 0.5 * h;
        jacobian_known_ = true;
        continue;
      }
      const State y = y_ + z.col(2), ze = z * kError / h;
      const State larger = absolute_ + tolerance_ * y_.cwiseAbs().cwiseMax(y.cwiseAbs());
      State error = real_.solve(State(f_ + ze));
      double e = norm(error, larger);
      State f;
      if (rejected && e > 1.0 && evaluate(t_, y_ + error, f)) e = norm(real_.solve(State(f + ze)), larger);
      const double safety = 0.9 * (2.0 * kMaxIterations + 1.0) / (2.0 * kMaxIterations + iterations_);
      const double change = safety * factor_for(h, e);
      if (!(e <= 1.0) || !evaluate(t_ + h, y, f)) {
        h_ = h * (e > 1.0 ? std::clamp(change, 0.2, 0.9) : 0.5);
        rejected = true;
        continue;
      }
      accept(h, y, z, f, e, change);
      return;
    }
  }

  void accept(double h, const State& y, const Stages& z, const State& f, double error, double change) {
    before_ = t_;
    from_ = y_;
    t_ += h;
    y_ = y;
    f_ = f;
    dense_ = z * kRadauDense;
    last_h_ = h;
    last_error_ = error;
    stepped_ = true;
    if (iterations_ > 2 && rate_ > 1e-3) jacobian_known_ = false;
    const double next = h * std::clamp(change, 0.2, 10.0);
    if (next > 1.2 * h_ || next < h_ || !jacobian_known_) h_ = next;
  }

  Rates rates_;
  int size_;
  double newton_tolerance_ = 0.0;
  State from_, f_;  ///< start of the last step; rates at its end
  Jacobian jacobian_;
  Eigen::PartialPivLU<Jacobian> real_;
  Eigen::PartialPivLU<ComplexMatrix> complex_;
  double factored_for_ = 0.0, rate_ = 0.0, convergence_ = 1.0, last_h_ = 0.0, last_error_ = 0.0;
  int iterations_ = 0;
  bool jacobian_known_ = false, factored_ = false, stepped_ = false;
  Eigen::Matrix<double, Eigen::Dynamic, 3, 0, kMaxEquations, 3> dense_;
};

}  // namespace

std::unique_ptr<OdeSolver> make_radau(int size, OdeSolver::Rates rates) {
  return std::make_unique<Radau>(size, std::move(rates));
}

}  // namespace spring_workbench::benchmark
