#include "benchmark/cvode_integrator.h"

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

namespace spring_workbench::benchmark {
namespace {

int right_side(realtype t, N_Vector y, N_Vector rate, void* rates) {
  const bool fine =
      (*static_cast<const CvodeIntegrator::Rates*>(rates))(t, N_VGetArrayPointer(y), N_VGetArrayPointer(rate));
  return fine ? 0 : 1;  // 1: try a smaller step
}

void require(int status, const char* call) {
  if (status < 0) throw std::runtime_error(std::string(call) + " failed with status " + std::to_string(status));
}

void ignore_message(int, const char*, const char*, char*, void*) {}

}  // namespace

struct CvodeIntegrator::Impl {
  Impl(int size, Rates given, Formula formula) : rates(std::move(given)) {
    require(SUNContext_Create(nullptr, &context), "SUNContext_Create");
    y = N_VNew_Serial(size, context);
    absolute_tolerance = N_VNew_Serial(size, context);
    N_VConst(0.0, y);
    matrix = SUNDenseMatrix(size, size, context);
    linear_solver = SUNLinSol_Dense(y, matrix, context);
    cvode = CVodeCreate(formula == Formula::bdf ? CV_BDF : CV_ADAMS, context);
    require(CVodeInit(cvode, right_side, 0.0, y), "CVodeInit");
    require(CVodeSetUserData(cvode, &rates), "CVodeSetUserData");
    require(CVodeSetErrHandlerFn(cvode, ignore_message, nullptr), "CVodeSetErrHandlerFn");
    require(CVodeSetMaxNumSteps(cvode, 10000000), "CVodeSetMaxNumSteps");
    if (formula == Formula::bdf) {
      require(CVodeSetLinearSolver(cvode, linear_solver, matrix), "CVodeSetLinearSolver");
    } else {
      fixed_point = SUNNonlinSol_FixedPoint(y, 0, context);
      require(CVodeSetNonlinearSolver(cvode, fixed_point), "CVodeSetNonlinearSolver");
    }
  }

  ~Impl() {
    CVodeFree(&cvode);
    if (fixed_point != nullptr) SUNNonlinSolFree(fixed_point);
    SUNLinSolFree(linear_solver);
    SUNMatDestroy(matrix);
    N_VDestroy(absolute_tolerance);
    N_VDestroy(y);
    SUNContext_Free(&context);
  }

  Rates rates;
  SUNContext context = nullptr;
  N_Vector y = nullptr;
  N_Vector absolute_tolerance = nullptr;
  SUNMatrix matrix = nullptr;
  SUNLinearSolver linear_solver = nullptr;
  SUNNonlinearSolver fixed_point = nullptr;
  void* cvode = nullptr;
  double reached = 0.0;
};

CvodeIntegrator::CvodeIntegrator(int size, Rates rates, Formula formula)
    : impl_(std::make_unique<Impl>(size, std::move(rates), formula)) {}
CvodeIntegrator::~CvodeIntegrator() = default;

void CvodeIntegrator::begin(double t, const std::vector<double>& y, double tolerance,
                            const std::vector<double>& scale) {
  std::copy(y.begin(), y.end(), N_VGetArrayPointer(impl_->y));
  std::copy(scale.begin(), scale.end(), N_VGetArrayPointer(impl_->absolute_tolerance));
  N_VScale(tolerance, impl_->absolute_tolerance, impl_->absolute_tolerance);
  restart(t);
  require(CVodeSVtolerances(impl_->cvode, tolerance, impl_->absolute_tolerance), "CVodeSVtolerances");
}

void CvodeIntegrator::restart(double t) {
  impl_->reached = t;
  require(CVodeReInit(impl_->cvode, t, impl_->y), "CVodeReInit");
}

const double* CvodeIntegrator::advance(double t, bool stop_there) {
  if (stop_there) require(CVodeSetStopTime(impl_->cvode, t), "CVodeSetStopTime");
  if (t > impl_->reached) require(CVode(impl_->cvode, t, impl_->y, &impl_->reached, CV_NORMAL), "CVode");
  return N_VGetArrayPointer(impl_->y);
}

}  // namespace spring_workbench::benchmark
