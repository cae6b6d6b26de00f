#pragma once

#include <functional>
#include <limits>
#include <memory>
#include <string>
#include <vector>

namespace spring_workbench::benchmark {

constexpr double kNever = std::numeric_limits<double>::infinity();  ///< [s]

/// A general solver of y' = f(t, y).
class OdeSolver {
 public:
  /// Computes the rates of the state `y` at `t` into `rate`; returns false if the state is outside the domain of the
  /// equations.
  using Rates = std::function<bool(double t, const double* y, double* rate)>;

  virtual ~OdeSolver() = default;

  /// Starts at `t` with `y`. `tolerance`: relative tolerance; the absolute one of each entry is `tolerance` times its
  /// `scale`.
  virtual void begin(double t, const std::vector<double>& y, double tolerance, const std::vector<double>& scale) = 0;
  /// Integrates to `t` and returns the state there, valid until the next call; between the ends of steps by the
  /// solver's own dense output. The rates are not evaluated beyond `stop` ≥ `t`, which may be kNever, and may be
  /// discontinuous there: if `t` is `stop`, the solver restarts. Throws std::runtime_error if the solver fails.
  virtual const double* advance(double t, double stop) = 0;
};

/// The classical Runge–Kutta method with equal steps of at most `step` [s], up to twelve equations. Tolerance and scale
/// are not used.
std::unique_ptr<OdeSolver> make_rk4(int size, double step, OdeSolver::Rates rates);

/// The linearly implicit Euler method with equal steps of at most `step` [s]: one evaluation at the end of a step, and
/// one solution with the Jacobian of the start of the run, which is found by differences. Up to twelve equations.
std::unique_ptr<OdeSolver> make_implicit_euler(int size, double step, OdeSolver::Rates rates);

/// Twelve stages of order eight with error estimates of order five and three and dense output of order seven (Dormand
/// and Prince; Hairer, Nørsett and Wanner, Solving ODEs I, II.5 and II.10), up to twelve equations.
std::unique_ptr<OdeSolver> make_dop853(int size, OdeSolver::Rates rates);

/// The three-stage Radau IIA method of order five with simplified Newton iteration (Hairer and Wanner, Solving ODEs II,
/// IV.8), Jacobian by differences, dense output by the collocation polynomial, up to twelve equations.
std::unique_ptr<OdeSolver> make_radau(int size, OdeSolver::Rates rates);

/// SUNDIALS CVODE: backward differentiation with Newton's method and a dense Jacobian by differences, or Adams'
/// formulas with fixed-point iteration.
enum class CvodeFormula { bdf, adams };
std::unique_ptr<OdeSolver> make_cvode(CvodeFormula formula, int size, OdeSolver::Rates rates);

/// SUNDIALS ARKODE of order five with dense output, explicit or diagonally implicit (Newton, dense Jacobian by
/// differences).
std::unique_ptr<OdeSolver> make_arkode(bool implicit, int size, OdeSolver::Rates rates);

}  // namespace spring_workbench::benchmark
