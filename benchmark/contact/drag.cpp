#include "benchmark/contact/drag.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "benchmark/contact/processor_time.h"

namespace spring_workbench::benchmark {
namespace {

constexpr double press_time = 1.0, pressed = 0.1, dragged = 0.5;  // s, m, m

double depth(const RigidTransform& X_WO, const Vector3d& size) {
  return 0.5 * X_WO.linear().row(2).cwiseAbs().dot(size) - X_WO.translation().z();
}

}  // namespace

double DragScene::damping() const { return 2.0 * std::sqrt(mass * stiffness()); }

double DragScene::turning_damping() const { return 2.0 * std::sqrt(inertia().z() * turning_stiffness()); }

Vector3d DragScene::inertia() const {
  const Vector3d s = size.cwiseAbs2();
  return mass / 12.0 * Vector3d(s.y() + s.z(), s.x() + s.z(), s.x() + s.y());
}

double DragScene::exact_lag() const { return friction * (pressed + mass * gravity / stiffness()); }

DragHand drag_hand(const DragScene& scene, double t) {
  DragHand hand{Vector3d(0.0, 0.0, 0.5 * scene.size.z() - pressed), Vector3d::Zero(), Vector3d::Zero()};
  if (t >= press_time) {
    hand.v_W.x() = dragged / (drag_duration - press_time);
    hand.p_W.x() = hand.v_W.x() * (t - press_time);
    return hand;
  }
  const double u = std::max(0.0, t / press_time), left = 1.0 - u * u * u * (10.0 + u * (-15.0 + 6.0 * u));
  hand.p_W.z() += pressed * left;
  hand.v_W.z() = -pressed / press_time * 30.0 * u * u * (1.0 - u) * (1.0 - u);
  hand.a_W.z() = -pressed / (press_time * press_time) * 60.0 * u * (1.0 - u) * (1.0 - 2.0 * u);
  return hand;
}

DragRow run_drag(const DragMethod& method, const DragScene& scene, double step, int runs) {
  DragRow row;
  row.method = method.name;
  row.stiffness_factor = scene.stiffness_factor;
  row.turns = scene.turns;
  const int steps = static_cast<int>(std::ceil(drag_duration / step - 1e-9));
  const double h = drag_duration / steps;
  row.step = h;
  row.finite = true;
  double least = std::numeric_limits<double>::infinity();
  for (int run = 0; run < runs && row.finite; ++run) {
    const std::unique_ptr<DragWorld> world = method.make(scene, h);
    double spent = 0.0;
    for (int i = 0; i < steps && row.finite; ++i) {
      const double begin = processor_time();
      world->step(i * h, h);
      spent += processor_time() - begin;
      const RigidTransform X_WO = world->box();
      row.finite = X_WO.matrix().allFinite() && X_WO.translation().norm() < 10.0;
      row.penetration = std::max(row.penetration, depth(X_WO, scene.size));
    }
    least = std::min(least, spent);
    row.lag = drag_hand(scene, drag_duration).p_W.x() - world->box().translation().x();
  }
  row.lag_error = std::abs(row.lag / scene.exact_lag() - 1.0);
  row.cpu_us_per_simulated_second = 1e6 * least / drag_duration;
  row.cpu_us_per_step = 1e6 * least / steps;
  return row;
}

}  // namespace spring_workbench::benchmark
