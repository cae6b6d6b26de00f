#include "benchmark/baselines.h"
#include "benchmark/held_body.h"
#include "benchmark/single_spring.h"
#include "benchmark/stepping_loop.h"
#include "spring_workbench/math/so3.h"

namespace spring_workbench::benchmark {
namespace {

BodyAcceleration acceleration(const Scenario& scene, const HandState& hand, const BodyState& body) {
  return body_acceleration(scene, bushing_load(scene, hand, body), body.w_WO_O);
}

/// R ← R exp(h w)
Quaterniond turned(const Quaterniond& R, const Vector3d& h_w) {
  const double angle = h_w.norm();
  const double s = angle > 1e-8 ? std::sin(0.5 * angle) / angle : 0.5;
  return (R * Quaterniond(std::cos(0.5 * angle), s * h_w.x(), s * h_w.y(), s * h_w.z())).normalized();
}

class SemiImplicitEuler : public Method {
 public:
  std::string name() const override { return "hand_semi_implicit_euler"; }

  RunResult run(const Scenario& scene, double step) const override {
    return scene.kind == SceneKind::six_dof ? run_body(scene, step) : run_single(scene, step);
  }

 private:
  static RunResult run_single(const Scenario& scene, double step) {
    const SingleSpring spring(scene);
    double x = scalar_hand(scene, 0.0).value, v = scalar_hand(scene, 0.0).rate;
    return stepping_loop(
        scene, step,
        [&](double t, double h) {
          v += h * spring.acceleration(scalar_hand(scene, t), x, v);
          x += h * v;
        },
        [&](double) { return Vector3d(0.0, 0.0, x); });
  }

  static RunResult run_body(const Scenario& scene, double step) {
    BodyState body = start_state(scene);
    return stepping_loop(
        scene, step,
        [&](double t, double h) {
          const BodyAcceleration a = acceleration(scene, hand_state(scene, t), body);
          body.v_WO_W += h * a.a_WO_W;
          body.w_WO_O += h * a.alpha_WO_O;
          body.p_WO += h * body.v_WO_W;
          body.R_WO = turned(body.R_WO, h * body.w_WO_O);
        },
        [&](double) { return body.p_WO; });
  }
};

/// Evaluates the hand once per distinct time: the middle stages share it, and the last one is the first of the next
/// step.
class RungeKutta4 : public Method {
 public:
  std::string name() const override { return "hand_rk4"; }

  RunResult run(const Scenario& scene, double step) const override {
    return scene.kind == SceneKind::six_dof ? run_body(scene, step) : run_single(scene, step);
  }

 private:
  static RunResult run_single(const Scenario& scene, double step) {
    const SingleSpring spring(scene);
    ScalarMotion hand = scalar_hand(scene, 0.0);
    double x = hand.value, v = hand.rate;
    return stepping_loop(
        scene, step,
        [&](double t, double h) {
          const ScalarMotion middle = scalar_hand(scene, t + 0.5 * h);
          const double a1 = spring.acceleration(hand, x, v);
          const double v2 = v + 0.5 * h * a1;
          const double a2 = spring.acceleration(middle, x + 0.5 * h * v, v2);
          const double v3 = v + 0.5 * h * a2;
          const double a3 = spring.acceleration(middle, x + 0.5 * h * v2, v3);
          const double v4 = v + h * a3;
          hand = scalar_hand(scene, t + h);
          const double a4 = spring.acceleration(hand, x + h * v3, v4);
          x += h / 6.0 * (v + 2.0 * v2 + 2.0 * v3 + v4);
          v += h / 6.0 * (a1 + 2.0 * a2 + 2.0 * a3 + a4);
        },
        [&](double) { return Vector3d(0.0, 0.0, x); });
  }

  struct Rate {
    Vector3d v, a;
    Eigen::Vector4d R;
    Vector3d alpha;
  };

  static Rate rate(const Scenario& scene, const HandState& hand, const BodyState& body) {
    const BodyAcceleration a = acceleration(scene, hand, body);
    const Quaterniond w(0.0, body.w_WO_O.x(), body.w_WO_O.y(), body.w_WO_O.z());
    return {body.v_WO_W, a.a_WO_W, 0.5 * (body.R_WO * w).coeffs(), a.alpha_WO_O};
  }

  static BodyState moved(const BodyState& body, double h, const Rate& rate) {
    BodyState next = body;
    next.p_WO += h * rate.v;
    next.v_WO_W += h * rate.a;
    next.R_WO.coeffs() += h * rate.R;
    next.R_WO.normalize();
    next.w_WO_O += h * rate.alpha;
    return next;
  }

  static RunResult run_body(const Scenario& scene, double step) {
    BodyState body = start_state(scene);
    HandState hand = hand_state(scene, 0.0);
    return stepping_loop(
        scene, step,
        [&](double t, double h) {
          const HandState middle = hand_state(scene, t + 0.5 * h);
          const Rate k1 = rate(scene, hand, body);
          const Rate k2 = rate(scene, middle, moved(body, 0.5 * h, k1));
          const Rate k3 = rate(scene, middle, moved(body, 0.5 * h, k2));
          hand = hand_state(scene, t + h);
          const Rate k4 = rate(scene, hand, moved(body, h, k3));
          body = moved(body, h / 6.0,
                       {k1.v + 2.0 * (k2.v + k3.v) + k4.v, k1.a + 2.0 * (k2.a + k3.a) + k4.a,
                        k1.R + 2.0 * (k2.R + k3.R) + k4.R, k1.alpha + 2.0 * (k2.alpha + k3.alpha) + k4.alpha});
        },
        [&](double) { return body.p_WO; });
  }
};

}  // namespace

std::vector<MethodPtr> hand_written_baselines() {
  std::vector<MethodPtr> baselines;
  baselines.push_back(std::make_unique<SemiImplicitEuler>());
  baselines.push_back(std::make_unique<RungeKutta4>());
  return baselines;
}

}  // namespace spring_workbench::benchmark
