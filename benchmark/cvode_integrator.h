#pragma once

#include <memory>
#include <vector>

#include "benchmark/ode_solver.h"

namespace spring_workbench::benchmark {

/// SUNDIALS CVODE on a system of first-order equations.
class CvodeIntegrator final : public OdeSolver {
 public:
  enum class Formula {
    bdf,   ///< Newton, dense Jacobian by differences
    adams  ///< fixed-point iteration
  };

  CvodeIntegrator(int size, Rates rates, Formula formula = Formula::bdf);
  ~CvodeIntegrator() override;
  CvodeIntegrator(const CvodeIntegrator&) = delete;
  CvodeIntegrator& operator=(const CvodeIntegrator&) = delete;

  void begin(double t, const std::vector<double>& y, double tolerance, const std::vector<double>& scale) override;
  /// restart() after a stop where the rates are not smooth there.
  const double* advance(double t, bool stop_there = false) override;
  void restart(double t);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace spring_workbench::benchmark
