#include "benchmark/cvode_solver.h"

#include <cvode/cvode.h>
#include <nvector/nvector_serial.h>
#include <sundials/sundials_context.h>
#include <sunlinsol/sunlinsol_dense.h>
#include <sunmatrix/sunmatrix_dense.h>

#include <stdexcept>
#include <string>

#include "benchmark/reference_solution.h"

namespace spring_workbench::benchmark {
namespace {

int single_right_side(realtype t, N_Vector y_vector, N_Vector rate_vector, void* data) {
  const auto& scene = *static_cast<const Scenario*>(data);
  const realtype* y = N_VGetArrayPointer(y_vector);
  realtype* rate = N_VGetArrayPointer(rate_vector);
  const int i = scene.single_coordinate();
  const double gravity = scene.kind == SceneKind::stretch ? scene.gravity : 0.0;
  rate[0] = y[1];
  rate[1] = -(scene.stiffness[i] * y[0] + scene.damping[i] * y[1]) / scene.single_inertia() - gravity -
            scalar_hand(scene, t).acceleration;
  return 0;
}

int bushing_right_side(realtype t, N_Vector y_vector, N_Vector rate_vector, void* data) {
  const auto& scene = *static_cast<const Scenario*>(data);
  const realtype* y = N_VGetArrayPointer(y_vector);
  BushingState state;
  state.q = Eigen::Map<const Vector6d>(y);
  state.q_dot = Eigen::Map<const Vector6d>(y + 6);
  if (!state.q.allFinite() || state.q.tail<3>().norm() > 6.0) return 1;  // recoverable: try a smaller step
  Eigen::Map<Vector6d> q_dot(N_VGetArrayPointer(rate_vector));
  Eigen::Map<Vector6d> q_ddot(N_VGetArrayPointer(rate_vector) + 6);
  q_dot = state.q_dot;
  q_ddot = bushing_acceleration(scene, t, state);
  return 0;
}

void require(int status, const char* call) {
  if (status < 0) throw std::runtime_error(std::string(call) + " failed with status " + std::to_string(status));
}

void ignore_message(int, const char*, const char*, char*, void*) {}

}  // namespace

struct CvodeSolver::Impl {
  explicit Impl(const Scenario& given) : scene(given), size(given.kind == SceneKind::six_dof ? 12 : 2) {
    require(SUNContext_Create(nullptr, &context), "SUNContext_Create");
    y = N_VNew_Serial(size, context);
    absolute_tolerance = N_VNew_Serial(size, context);
    matrix = SUNDenseMatrix(size, size, context);
    linear_solver = SUNLinSol_Dense(y, matrix, context);
    cvode = CVodeCreate(CV_BDF, context);
    N_VConst(0.0, y);
    require(CVodeInit(cvode, size == 2 ? single_right_side : bushing_right_side, 0.0, y), "CVodeInit");
    require(CVodeSetUserData(cvode, &scene), "CVodeSetUserData");
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

  void set_tolerance(double tolerance) {
    const Vector6d scale = deflection_scale(scene);
    realtype* atol = N_VGetArrayPointer(absolute_tolerance);
    const int half = static_cast<int>(size) / 2;
    for (int i = 0; i < half; ++i) {
      atol[i] = tolerance * scale[half == 1 ? scene.single_coordinate() : i];
      atol[half + i] = 10.0 * atol[i];
    }
    require(CVodeSVtolerances(cvode, tolerance, absolute_tolerance), "CVodeSVtolerances");
  }

  Vector3d output(double t) const {
    const realtype* values = N_VGetArrayPointer(y);
    if (size == 2) return Vector3d(0.0, 0.0, scalar_hand(scene, t).value + values[0]);
    BushingState state;
    state.q = Eigen::Map<const Vector6d>(values);
    return body_state(scene, hand_state(scene, t), state).p_WO;
  }

  Scenario scene;
  sunindextype size;
  SUNContext context = nullptr;
  N_Vector y = nullptr;
  N_Vector absolute_tolerance = nullptr;
  SUNMatrix matrix = nullptr;
  SUNLinearSolver linear_solver = nullptr;
  void* cvode = nullptr;
};

CvodeSolver::CvodeSolver(const Scenario& scene) : impl_(std::make_unique<Impl>(scene)) {}
CvodeSolver::~CvodeSolver() = default;

std::vector<Vector3d> CvodeSolver::solve(double tolerance) {
  Impl& s = *impl_;
  N_VConst(0.0, s.y);
  require(CVodeReInit(s.cvode, 0.0, s.y), "CVodeReInit");
  s.set_tolerance(tolerance);
  std::vector<Vector3d> outputs;
  for (const double end : output_times(s.scene)) {
    double reached = 0.0;
    if (end > 0.0) require(CVode(s.cvode, end, s.y, &reached, CV_NORMAL), "CVode");
    outputs.push_back(s.output(end));
  }
  return outputs;
}

}  // namespace spring_workbench::benchmark
