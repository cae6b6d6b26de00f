#include "benchmark/cvode_solver.h"

#include <cvode/cvode.h>
#include <nvector/nvector_serial.h>
#include <sundials/sundials_context.h>
#include <sunlinsol/sunlinsol_dense.h>
#include <sunmatrix/sunmatrix_dense.h>

#include <stdexcept>
#include <string>

namespace spring_workbench::benchmark {
namespace {

int right_side(realtype t, N_Vector y, N_Vector rate, void* problem) {
  const bool fine =
      static_cast<const CvodeProblem*>(problem)->rates(t, N_VGetArrayPointer(y), N_VGetArrayPointer(rate));
  return fine ? 0 : 1;  // 1: try a smaller step
}

void require(int status, const char* call) {
  if (status < 0) throw std::runtime_error(std::string(call) + " failed with status " + std::to_string(status));
}

void ignore_message(int, const char*, const char*, char*, void*) {}

}  // namespace

struct CvodeSolver::Impl {
  Impl(const Scenario& given, CvodeCoordinates coordinates)
      : scene(given), problem(make_cvode_problem(given, coordinates)) {
    const sunindextype size = problem->size();
    require(SUNContext_Create(nullptr, &context), "SUNContext_Create");
    y = N_VNew_Serial(size, context);
    absolute_tolerance = N_VNew_Serial(size, context);
    matrix = SUNDenseMatrix(size, size, context);
    linear_solver = SUNLinSol_Dense(y, matrix, context);
    cvode = CVodeCreate(CV_BDF, context);
    problem->start(N_VGetArrayPointer(y));
    require(CVodeInit(cvode, right_side, 0.0, y), "CVodeInit");
    require(CVodeSetUserData(cvode, problem.get()), "CVodeSetUserData");
    require(CVodeSetErrHandlerFn(cvode, ignore_message, nullptr), "CVodeSetErrHandlerFn");
    require(CVodeSetMaxNumSteps(cvode, 10000000), "CVodeSetMaxNumSteps");
    require(CVodeSetLinearSolver(cvode, linear_solver, matrix), "CVodeSetLinearSolver");
  }

  ~Impl() {
    CVodeFree(&cvode);
    SUNLinSolFree(linear_solver);
    SUNMatDestroy(matrix);
    N_VDestroy(absolute_tolerance);
    N_VDestroy(y);
    SUNContext_Free(&context);
  }

  Scenario scene;
  std::unique_ptr<CvodeProblem> problem;
  SUNContext context = nullptr;
  N_Vector y = nullptr;
  N_Vector absolute_tolerance = nullptr;
  SUNMatrix matrix = nullptr;
  SUNLinearSolver linear_solver = nullptr;
  void* cvode = nullptr;
};

CvodeSolver::CvodeSolver(const Scenario& scene, CvodeCoordinates coordinates)
    : impl_(std::make_unique<Impl>(scene, coordinates)) {}
CvodeSolver::~CvodeSolver() = default;

std::vector<Vector3d> CvodeSolver::solve(double tolerance) {
  Impl& s = *impl_;
  double* y = N_VGetArrayPointer(s.y);
  s.problem->start(y);
  require(CVodeReInit(s.cvode, 0.0, s.y), "CVodeReInit");
  s.problem->tolerance_scale(N_VGetArrayPointer(s.absolute_tolerance));
  N_VScale(tolerance, s.absolute_tolerance, s.absolute_tolerance);
  require(CVodeSVtolerances(s.cvode, tolerance, s.absolute_tolerance), "CVodeSVtolerances");
  std::vector<Vector3d> outputs;
  for (const double end : output_times(s.scene)) {
    double reached = 0.0;
    if (end > 0.0) require(CVode(s.cvode, end, s.y, &reached, CV_NORMAL), "CVode");
    outputs.push_back(s.problem->output(end, y));
  }
  return outputs;
}

}  // namespace spring_workbench::benchmark
