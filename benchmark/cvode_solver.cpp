#include <cvode/cvode.h>
#include <nvector/nvector_serial.h>
#include <sundials/sundials_context.h>
#include <sunlinsol/sunlinsol_dense.h>
#include <sunmatrix/sunmatrix_dense.h>
#include <sunnonlinsol/sunnonlinsol_fixedpoint.h>

#include <algorithm>
#include <stdexcept>
#include <string>
#include <utility>

#include "benchmark/ode_solver.h"
#include "benchmark/sundials_calls.h"

namespace spring_workbench::benchmark {
namespace {

class Cvode final : public OdeSolver {
 public:
  Cvode(CvodeFormula formula, int size, Rates rates) : rates_(std::move(rates)) {
    require(SUNContext_Create(nullptr, &context_), "SUNContext_Create");
    y_ = N_VNew_Serial(size, context_);
    absolute_ = N_VNew_Serial(size, context_);
    N_VConst(0.0, y_);
    matrix_ = SUNDenseMatrix(size, size, context_);
    linear_solver_ = SUNLinSol_Dense(y_, matrix_, context_);
    cvode_ = CVodeCreate(formula == CvodeFormula::bdf ? CV_BDF : CV_ADAMS, context_);
    require(CVodeInit(cvode_, right_side, 0.0, y_), "CVodeInit");
    require(CVodeSetUserData(cvode_, &rates_), "CVodeSetUserData");
    require(CVodeSetErrHandlerFn(cvode_, ignore_message, nullptr), "CVodeSetErrHandlerFn");
    require(CVodeSetMaxNumSteps(cvode_, 10000000), "CVodeSetMaxNumSteps");
    if (formula == CvodeFormula::bdf) {
      require(CVodeSetLinearSolver(cvode_, linear_solver_, matrix_), "CVodeSetLinearSolver");
    } else {
      fixed_point_ = SUNNonlinSol_FixedPoint(y_, 0, context_);
      require(CVodeSetNonlinearSolver(cvode_, fixed_point_), "CVodeSetNonlinearSolver");
    }
  }
  Cvode(const Cvode&) = delete;
  Cvode& operator=(const Cvode&) = delete;
  ~Cvode() override {
    CVodeFree(&cvode_);
    if (fixed_point_ != nullptr) SUNNonlinSolFree(fixed_point_);
    SUNLinSolFree(linear_solver_);
    SUNMatDestroy(matrix_);
    N_VDestroy(absolute_);
    N_VDestroy(y_);
    SUNContext_Free(&context_);
  }

  void begin(double t, const std::vector<double>& y, double tolerance, const std::vector<double>& scale) override {
    std::copy(y.begin(), y.end(), N_VGetArrayPointer(y_));
    std::copy(scale.begin(), scale.end(), N_VGetArrayPointer(absolute_));
    N_VScale(tolerance, absolute_, absolute_);
    reinitialise(t, 0.0);
    require(CVodeSVtolerances(cvode_, tolerance, absolute_), "CVodeSVtolerances");
  }

  const double* advance(double t, double stop) override {
    if (stop < kNever) require(CVodeSetStopTime(cvode_, stop), "CVodeSetStopTime");
    if (t > reached_) require(CVode(cvode_, t, y_, &reached_, CV_NORMAL), "CVode");
    if (t == stop) {
      double step = 0.0;  // spares it another search; a start at order one needs shorter steps than those just before
      require(CVodeGetActualInitStep(cvode_, &step), "CVodeGetActualInitStep");
      reinitialise(t, step);
    }
    return N_VGetArrayPointer(y_);
  }

 private:
  void reinitialise(double t, double step) {
    reached_ = t;
    require(CVodeReInit(cvode_, t, y_), "CVodeReInit");
    require(CVodeSetInitStep(cvode_, step), "CVodeSetInitStep");
  }

  Rates rates_;
  SUNContext context_ = nullptr;
  N_Vector y_ = nullptr, absolute_ = nullptr;
  SUNMatrix matrix_ = nullptr;
  SUNLinearSolver linear_solver_ = nullptr;
  SUNNonlinearSolver fixed_point_ = nullptr;
  void* cvode_ = nullptr;
  double reached_ = 0.0;
};

}  // namespace

std::unique_ptr<OdeSolver> make_cvode(CvodeFormula formula, int size, OdeSolver::Rates rates) {
  return std::make_unique<Cvode>(formula, size, std::move(rates));
}

}  // namespace spring_workbench::benchmark
