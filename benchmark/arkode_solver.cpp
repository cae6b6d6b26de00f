#include <arkode/arkode_arkstep.h>
#include <nvector/nvector_serial.h>
#include <sundials/sundials_context.h>
#include <sunlinsol/sunlinsol_dense.h>
#include <sunmatrix/sunmatrix_dense.h>

#include <algorithm>
#include <stdexcept>
#include <string>
#include <utility>

#include "benchmark/ode_solver.h"
#include "benchmark/sundials_calls.h"

namespace spring_workbench::benchmark {
namespace {

class Arkode final : public OdeSolver {
 public:
  Arkode(bool implicit, int size, Rates rates) : rates_(std::move(rates)), implicit_(implicit) {
    require(SUNContext_Create(nullptr, &context_), "SUNContext_Create");
    y_ = N_VNew_Serial(size, context_);
    absolute_ = N_VNew_Serial(size, context_);
    matrix_ = SUNDenseMatrix(size, size, context_);
    linear_solver_ = SUNLinSol_Dense(y_, matrix_, context_);
  }
  Arkode(const Arkode&) = delete;
  Arkode& operator=(const Arkode&) = delete;
  ~Arkode() override {
    ARKStepFree(&arkode_);
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
    reached_ = t;
    ARKStepFree(&arkode_);
    arkode_ = ARKStepCreate(implicit_ ? nullptr : right_side, implicit_ ? right_side : nullptr, t, y_, context_);
    if (arkode_ == nullptr) throw std::runtime_error("ARKStepCreate failed");
    require(ARKStepSetUserData(arkode_, &rates_), "ARKStepSetUserData");
    require(ARKStepSetErrHandlerFn(arkode_, ignore_message, nullptr), "ARKStepSetErrHandlerFn");
    require(ARKStepSetOrder(arkode_, 5), "ARKStepSetOrder");
    require(ARKStepSetMaxNumSteps(arkode_, 10000000), "ARKStepSetMaxNumSteps");
    require(ARKStepSVtolerances(arkode_, tolerance, absolute_), "ARKStepSVtolerances");
    if (!implicit_) return;
    // As recommended in its guide for equations that may be stiff.
    require(ARKStepSetInterpolantType(arkode_, ARK_INTERP_LAGRANGE), "ARKStepSetInterpolantType");
    require(ARKStepSetLinearSolver(arkode_, linear_solver_, matrix_), "ARKStepSetLinearSolver");
    // With a matrix of up to 20 steps before, its default, a stage may end after one iteration that has not converged:
    // the error then grows as the tolerance falls.
    require(ARKStepSetLSetupFrequency(arkode_, 1), "ARKStepSetLSetupFrequency");
  }

  const double* advance(double t, double stop) override {
    if (stop < kNever) require(ARKStepSetStopTime(arkode_, stop), "ARKStepSetStopTime");
    if (t > reached_) require(ARKStepEvolve(arkode_, t, y_, &reached_, ARK_NORMAL), "ARKStepEvolve");
    if (t == stop) require(ARKStepReset(arkode_, t, y_), "ARKStepReset");  // the rates may jump; keeps the step size
    return N_VGetArrayPointer(y_);
  }

 private:
  Rates rates_;
  bool implicit_;
  SUNContext context_ = nullptr;
  N_Vector y_ = nullptr, absolute_ = nullptr;
  SUNMatrix matrix_ = nullptr;
  SUNLinearSolver linear_solver_ = nullptr;
  void* arkode_ = nullptr;
  double reached_ = 0.0;
};

}  // namespace

std::unique_ptr<OdeSolver> make_arkode(bool implicit, int size, OdeSolver::Rates rates) {
  return std::make_unique<Arkode>(implicit, size, std::move(rates));
}

}  // namespace spring_workbench::benchmark
