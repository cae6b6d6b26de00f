#include "energy_account.h"

#include <algorithm>
#include <cmath>

#include "spring_workbench/math/so3.h"

namespace spring_workbench::stepping {
namespace {

/// Returns the same forcing with the frames of the couplings at rest in the frame of the handle.
dynamics::HandleState with_frames_at_rest(dynamics::HandleState handle) {
  for (std::size_t i = 0; i < handle.relative_motions.count; ++i) {
    handle.relative_motions.in_frame(i).v_AB = handle.relative_motions.in_frame(i).w_AB = math::zero<double>();
  }
  return handle;
}

}  // namespace

Difference difference(const dynamics::HeldBody& body, const dynamics::HandleState& handle,
                      const dynamics::StrainState& state, const dynamics::StrainState& other) {
  // The state last: its tip is the one asked for next.
  const motion::MotionState b = body.object(handle, other), a = body.object(handle, state);
  const double weight = body.body().mass * body.gravity();
  const auto kinetic = [&](const motion::MotionState& o) { return body.kinetic_energy(o.velocity, o.X.linear()); };
  const auto potential = [&](const motion::MotionState& o, const dynamics::StrainState& s) {
    return body.elastic_energy(handle.t, s) + body.read_couplings(handle, s).springs.energy +
           weight * (o.X.translation().z() - handle.X_WH.translation().z());
  };
  const double moving = kinetic(a), found = potential(a, state);
  const Wrench& load = body.load();
  const Vector3d moved = a.X.translation() - b.X.translation(), turned = b.X.linear() * math::turn_between(b.X, a.X);
  return {moved.norm(), turned.norm(),
          moving - kinetic(b) + found - potential(b, other) - load.force.dot(moved) - load.moment.dot(turned),
          std::max(moving + std::abs(found), weight * body.shape().length())};
}

double energy_added(const dynamics::HeldBody& body, const motion::Trajectory& handle, double t, double h,
                    const dynamics::StrainState& begin, const dynamics::StrainState& end) {
  constexpr double inner = 0.27639320225002103;  // (1 - 1/sqrt(5)) / 2
  constexpr math::Pack nodes{0.0, inner, 1.0 - inner, 1.0}, weights{1.0 / 12.0, 5.0 / 12.0, 5.0 / 12.0, 1.0 / 12.0};
  math::Pack q[rod::max_strain_coordinates], q_dot[rod::max_strain_coordinates];
  const auto curve = [&](bool straight) {
    for (int i = 0; i < body.size(); ++i) {
      const double change = end.q[i] - begin.q[i], a = straight ? change : h * begin.q_dot[i],
                   b = straight ? change : h * end.q_dot[i];
      const double second = 3.0 * change - 2.0 * a - b, third = a + b - 2.0 * change;
      q[i] = begin.q[i] + nodes * (a + nodes * (second + nodes * third));
      q_dot[i] = (a + nodes * (2.0 * second + nodes * (3.0 * third))) / h;
    }
  };
  const auto possible = [&](int node) {
    dynamics::StrainState at = begin;
    for (int i = 0; i < body.size(); ++i) at.q[i] = q[i][node];
    return body.shape().admissible(body.full_state(t + nodes[node] * h, at).q);
  };
  curve(false);
  if (!possible(1) || !possible(2)) curve(true);  // a jerk: no motion of the fork; the straight one
  const dynamics::EnergyBalance balance = body.energy_balance(body.state_at(handle, t + nodes * h), q, q_dot);
  return balance.energy[3] - balance.energy[0] - h * math::sum(weights * balance.power);
}

double energy_added(const dynamics::HeldBody& body, const motion::Trajectory& handle, double t, double h,
                    const dynamics::StrainState& begin, const dynamics::StrainState& end,
                    const dynamics::Integrator& integrator) {
  const std::optional<dynamics::StepWork> step = integrator.work(body);
  if (!step) return energy_added(body, handle, t, h, begin, end);
  math::Pack q[rod::max_strain_coordinates], q_dot[rod::max_strain_coordinates];
  for (int i = 0; i < body.size(); ++i) {
    q[i] = begin.q[i] + math::Pack{};
    q_dot[i] = begin.q_dot[i] + math::Pack{};
  }
  const dynamics::EnergyBalance before = body.energy_balance(body.state_at(handle, t + math::Pack{}), q, q_dot);
  return step->energy_at_end - before.energy[0] - step->work;
}

dynamics::HandleState over_step(const dynamics::HeldBody& body, const motion::Trajectory& handle, double t, double h) {
  dynamics::HandleState over = body.state_at(handle, t + h);
  const dynamics::HandleState middle = body.state_at(handle, t + 0.5 * h);
  over.w_WH_H = middle.w_WH_H;
  over.alpha_WH_H = middle.alpha_WH_H;
  over.proper_acceleration_H = middle.proper_acceleration_H;
  return over;
}

EnergyGain::EnergyGain(const dynamics::HeldBody& body, const dynamics::HandleState& handle,
                       const dynamics::StrainState& begin)
    : body_(body), still_(with_frames_at_rest(handle)), q_(begin.q) {
  const dynamics::StrainState at_rest{begin.q, 0.0 * begin.q_dot};
  // Weight, the handle's acceleration and the contact's force are constant on the way; other loads are as at the begin.
  const auto R_HW = handle.X_WH.linear().transpose();
  force_ = R_HW * body.load().force - body.body().mass * handle.proper_acceleration_H;
  const Wrench others = body.read_couplings(still_, at_rest).pull_W;
  Vector6d accounted;
  accounted << force_ + R_HW * others.force, R_HW * others.moment;
  loads_ = body.mass_matrix(handle.t, begin.q) * body.acceleration(handle, begin.q, at_rest.q_dot) +
           body.elastic_force(handle.t, begin.q) - body.object_jacobian(handle.t, begin.q).transpose() * accounted;
  energy_ = energy(begin);
}

double EnergyGain::operator()(const dynamics::StrainState& end) const {
  return energy(end) - energy_ - loads_.dot(end.q - q_);
}

double EnergyGain::energy(const dynamics::StrainState& state) const {
  const double t = still_.t;
  dynamics::HandleState origin;
  origin.t = t;
  return 0.5 * state.q_dot.dot(body_.mass_matrix(t, state.q) * state.q_dot) + body_.elastic_energy(t, state) +
         body_.read_couplings(still_, state).springs.energy - force_.dot(body_.object(origin, state).X.translation());
}

}  // namespace spring_workbench::stepping
