#include "benchmark/scene_problem.h"

#include <algorithm>
#include <cmath>

#include "benchmark/reference_solution.h"
#include "benchmark/single_spring.h"

namespace spring_workbench::benchmark {
namespace {

using Vector13d = Eigen::Matrix<double, 13, 1>;

/// Scenes A and B in the deflection and its rate.
class SingleDeflection : public SceneProblem {
 public:
  explicit SingleDeflection(const Scenario& scene) : spring_(scene) {}
  int size() const override { return 2; }
  void start(double* y) const override { std::fill_n(y, 2, 0.0); }
  void tolerance_scale(double* scale) const override {
    scale[0] = deflection_scale(spring_.scene)[spring_.scene.single_coordinate()];
    scale[1] = std::max(10.0, std::sqrt(spring_.stiffness / spring_.inertia)) * scale[0];
  }
  bool rates(double t, const double* y, double* rate) const override {
    rate[0] = y[1];
    rate[1] = -(spring_.stiffness * y[0] + spring_.damping * y[1]) / spring_.inertia - spring_.gravity -
              hand_.at(spring_.scene, t).acceleration;
    return true;
  }
  Vector3d output(double t, const double* y) const override {
    return Vector3d(0.0, 0.0, hand_.at(spring_.scene, t).value + y[0]);
  }

 private:
  SingleSpring spring_;
  mutable RememberedScalar hand_;
};

/// Scenes A and B in the object's height or twist and its rate.
class SingleWorld : public SceneProblem {
 public:
  explicit SingleWorld(const Scenario& scene) : spring_(scene) {}
  int size() const override { return 2; }
  void start(double* y) const override {
    y[0] = scalar_hand(spring_.scene, 0.0).value;
    y[1] = scalar_hand(spring_.scene, 0.0).rate;
  }
  void tolerance_scale(double* scale) const override { std::fill_n(scale, 2, 1.0); }
  bool rates(double t, const double* y, double* rate) const override {
    rate[0] = y[1];
    rate[1] = spring_.acceleration(hand_.at(spring_.scene, t), y[0], y[1]);
    return true;
  }
  Vector3d output(double, const double* y) const override { return Vector3d(0.0, 0.0, y[0]); }

 private:
  SingleSpring spring_;
  mutable RememberedScalar hand_;
};

/// Scene C in Lagrange's coordinates.
class BushingDeflection : public SceneProblem {
 public:
  explicit BushingDeflection(const Scenario& scene) : scene_(scene) {}
  int size() const override { return 12; }
  void start(double* y) const override { std::fill_n(y, 12, 0.0); }
  void tolerance_scale(double* scale) const override {
    const Vector6d deflection = deflection_scale(scene_);
    Eigen::Map<Vector6d>{scale} = deflection;
    const Vector3d arm = scene_.p_EO.cwiseAbs2();
    Vector6d inertia;
    inertia << Vector3d::Constant(scene_.mass), scene_.inertia + scene_.mass * (Vector3d::Constant(arm.sum()) - arm);
    // Scale of a rate: an error that causes the same relative error of the deflection, for uncoupled oscillations.
    const Vector6d omega = scene_.stiffness.cwiseQuotient(inertia).cwiseSqrt();
    Eigen::Map<Vector6d>{scale + 6} = omega.cwiseMax(10.0).cwiseProduct(deflection);
  }
  bool rates(double t, const double* y, double* rate) const override {
    BushingState state;
    state.q = Eigen::Map<const Vector6d>(y);
    state.q_dot = Eigen::Map<const Vector6d>(y + 6);
    if (!state.q.allFinite() || state.q.tail<3>().norm() > 6.0) return false;  // the rotation vector ends at 2π
    Eigen::Map<Vector6d>{rate} = state.q_dot;
    Eigen::Map<Vector6d>{rate + 6} = bushing_acceleration(scene_, hand_.at(scene_, t), state);
    return true;
  }
  Vector3d output(double t, const double* y) const override {
    BushingState state;
    state.q = Eigen::Map<const Vector6d>(y);
    return body_state(scene_, hand_.at(scene_, t).state, state).p_WO;
  }

 private:
  Scenario scene_;
  mutable RememberedMotion hand_;
};

/// Scene C in the object's position, velocity, quaternion and angular velocity.
class BodyWorld : public SceneProblem {
 public:
  explicit BodyWorld(const Scenario& scene) : scene_(scene) {}
  int size() const override { return 13; }
  void start(double* y) const override {
    const BodyState body = start_state(scene_);
    Eigen::Map<Vector13d>{y} << body.p_WO, body.v_WO_W, body.R_WO.coeffs(), body.w_WO_O;
  }
  void tolerance_scale(double* scale) const override { std::fill_n(scale, 13, 1.0); }
  bool rates(double t, const double* y, double* rate) const override {
    const Eigen::Map<const Vector13d> state(y);
    if (!state.allFinite()) return false;
    BodyState body;
    body.p_WO = state.segment<3>(0);
    body.v_WO_W = state.segment<3>(3);
    body.R_WO.coeffs() = state.segment<4>(6);
    const Quaterniond w(0.0, state[10], state[11], state[12]);
    const Eigen::Vector4d turning = 0.5 * (body.R_WO * w).coeffs();
    body.R_WO.normalize();
    body.w_WO_O = state.segment<3>(10);
    const BodyAcceleration a = body_acceleration(scene_, bushing_load(scene_, hand_.at(scene_, t), body), body.w_WO_O);
    Eigen::Map<Vector13d>{rate} << body.v_WO_W, a.a_WO_W, turning, a.alpha_WO_O;
    return true;
  }
  Vector3d output(double, const double* y) const override { return Eigen::Map<const Vector3d>(y); }

 private:
  Scenario scene_;
  mutable RememberedState hand_;
};

}  // namespace

std::unique_ptr<SceneProblem> make_scene_problem(const Scenario& scene, SceneCoordinates coordinates) {
  const bool world = coordinates == SceneCoordinates::world;
  if (scene.kind == SceneKind::six_dof) {
    if (world) return std::make_unique<BodyWorld>(scene);
    return std::make_unique<BushingDeflection>(scene);
  }
  if (world) return std::make_unique<SingleWorld>(scene);
  return std::make_unique<SingleDeflection>(scene);
}

}  // namespace spring_workbench::benchmark
