#pragma once

#include <functional>
#include <memory>
#include <vector>

namespace spring_workbench::benchmark {

/// SUNDIALS CVODE (BDF, Newton, dense Jacobian by differences) on a system of first-order equations.
class CvodeIntegrator {
 public:
  /// Rates of the state `y` at `t` into `rate`; false where the state is out of the equations' range.
  using Rates = std::function<bool(double t, const double* y, double* rate)>;

  CvodeIntegrator(int size, Rates rates);
  ~CvodeIntegrator();
  CvodeIntegrator(const CvodeIntegrator&) = delete;
  CvodeIntegrator& operator=(const CvodeIntegrator&) = delete;

  /// Begins at `t` with `y`. Tolerances: relative as given, absolute the same times `scale` of each entry.
  void begin(double t, const std::vector<double>& y, double tolerance, const std::vector<double>& scale);
  /// Goes on to `t`. What lies beyond `t` is not looked at where `stop_there`; restart() after that where the rates are
  /// not smooth at `t`. Throws std::runtime_error when CVODE gives up.
  const double* advance(double t, bool stop_there = false);
  void restart(double t);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace spring_workbench::benchmark
