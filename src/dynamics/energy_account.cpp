#include "energy_account.h"

namespace spring_workbench::dynamics {

double energy_added(const HeldBody& body, const motion::FrameMotion& handle, double t, double h,
                    const StrainState& begin, const StrainState& end) {
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
    StrainState at = begin;
    for (int i = 0; i < body.size(); ++i) at.q[i] = q[i][node];
    return body.shape().admissible(body.full_state(t + nodes[node] * h, at).q);
  };
  curve(false);
  if (!possible(1) || !possible(2)) curve(true);  // a jerk: no motion of the fork; the straight one
  const EnergyBalance balance = body.energy_balance(body.forcing(handle, t + nodes * h), q, q_dot);
  return balance.energy[3] - balance.energy[0] - h * math::sum(weights * balance.power);
}

double energy_gained(const HeldBody& body, const motion::FrameMotion& handle, double t, const StrainState& begin,
                     const StrainState& end) {
  const auto kinetic = [&](const StrainState& s) { return 0.5 * s.q_dot.dot(body.mass_matrix(t, s.q) * s.q_dot); };
  const HandleForcing H = body.forcing(handle, t);
  HandleForcing origin;
  origin.t = t;
  const auto position = [&](const StrainState& s) -> Vector3d { return body.object(origin, s).X.translation(); };
  // Weight, the handle's acceleration and the contact's force are constant on the way; other loads are as at the begin.
  const Vector3d force =
      H.X_WH.linear().transpose() * body.external_wrench().force - body.body().mass * H.acceleration_less_gravity;
  const rod::StrainVector loads = body.mass_matrix(t, begin.q) * body.acceleration(H, begin.q, 0.0 * begin.q_dot) +
                                  body.elastic_force(t, begin.q) -
                                  body.object_jacobian(t, begin.q).topRows<3>().transpose() * force;
  return kinetic(end) + body.elastic_energy(t, end) - kinetic(begin) - body.elastic_energy(t, begin) -
         loads.dot(end.q - begin.q) - force.dot(position(end) - position(begin));
}

}  // namespace spring_workbench::dynamics
