// Energy of the held body and its springs, and the power that changes it.
#include "equation_of_motion.h"
#include "spring_workbench/math/by_size.h"

namespace spring_workbench::dynamics {

template <int n>
SPRING_WORKBENCH_WIDE void HeldBody::balance(const HandleStates& handle, const math::Pack* q, const math::Pack* q_dot,
                                             EnergyBalance& out) const {
  using math::Pack, math::Vec3;
  const motion::BodyFrameRates<Pack>& h = handle.of_H;
  Pack springs[n];
  spring_forces<n>(q, q_dot, springs);
  rod::TipOf<Pack> tip;  // NOLINT(cppcoreguidelines-pro-type-member-init): rigid() sets all of it
  const Rigid<Pack> object = rigid<Pack>(handle, q, q_dot, tip);
  Pack elastic{}, damped{};
  for (int i = 0; i < n; ++i) {
    const Pack pull = K_[coordinates_[i]] * q[i];
    elastic += 0.5 * pull * q[i];
    damped += (springs[i] + pull) * q_dot[i];
  }
  const Vec3<Pack> v = h.v_B + math::cross(h.w_B, object.p_HO) + object.v_rel,
                   spin = math::mat3x3(body_.inertia_O) * object.w_O;
  const Vec3<Pack> about_H = object.R_HO * spin + body_.mass * math::cross(object.p_HO, v);
  const Vec3<Pack> g = gravity_ * Vec3<Pack>{h.R_WB.x.z, h.R_WB.y.z, h.R_WB.z.z};
  const Vec3<Pack> changed = h.a_B - g - math::cross(h.w_B, h.v_B);  // rate of h.v_B
  out.energy = elastic + 0.5 * (body_.mass * dot(v, v) + dot(object.w_O, spin)) +
               body_.mass * (dot(g, object.p_HO) - dot(v, h.v_B)) - dot(about_H, h.w_B);
  out.power =
      damped - dot(about_H, h.alpha_B) + body_.mass * (dot(h.w_B, math::cross(object.p_HO, g)) - dot(v, changed));
  if (!loaded_) return;
  out.power += dot(math::transposed(h.R_WB, math::vec3(load_W_.force)), object.v_rel) +
               dot(math::transposed(h.R_WB, math::vec3(load_W_.moment)), object.R_HO * object.w_O - h.w_B);
}

EnergyBalance HeldBody::energy_balance(const HandleStates& h, const math::Pack* q, const math::Pack* q_dot) const {
  EnergyBalance all = math::by_size(size(), [&](auto size) {
    EnergyBalance out;  // NOLINT(cppcoreguidelines-pro-type-member-init): balance() sets all of it
    balance<decltype(size)::value>(h, q, q_dot, out);
    return out;
  });
  for (int k = 0; k < math::pack_size && coupled(); ++k) {
    StrainState state = zero_state();
    for (int i = 0; i < size(); ++i) {
      state.q[i] = q[i][k];
      state.q_dot[i] = q_dot[i][k];
    }
    const HandleState at = h.at(k);
    const Couplings::Reading others = read_couplings(at, state);
    const Vector3d p_HO_W = object(at, state).X.translation() - at.X_WH.translation();
    const Wrench& pull = others.pull_W;
    all.energy[k] += others.springs.energy;
    all.power[k] += others.power - pull.force.dot(at.v_WH_W) -
                    (pull.moment + p_HO_W.cross(pull.force)).dot(at.X_WH.linear() * at.w_WH_H);
  }
  return all;
}

Couplings::Reading HeldBody::read_couplings(const HandleState& h, const StrainState& state) const {
  if (!coupled()) return {};
  const StrainState full = full_state(h.t, state);
  const rod::TipOf<double>& tip = this->tip(full.q.data(), full.q_dot.data(), false);
  math::Vec3<double> w = math::zero<double>(), v = w;
  rod::add_tip_motion(tip, coordinates_.count(), full.q_dot.data(), w, v);
  const math::Vec3<double> r_EO = tip.R_HE * math::vec3(p_EO_);
  const Matrix3d& R_WH = h.X_WH.linear();
  return couplings_.read(h.t, h.relative_motions,
                         {tip.R_HE * math::mat3x3(R_EO_), tip.p_HE + r_EO, v + math::cross(w, r_EO), w},
                         {math::mat3x3(R_WH), math::vec3(h.X_WH.translation()),
                          math::vec3(Vector3d(R_WH.transpose() * h.v_WH_W)), math::vec3(h.w_WH_H)});
}

double HeldBody::elastic_energy(double t, const StrainState& state) const {
  const StrainState full = full_state(t, state);
  return 0.5 * full.q.dot(K_.cwiseProduct(full.q));
}

rod::StrainVector HeldBody::elastic_force(double t, const rod::StrainVector& q) const {
  const StrainState full = full_state(t, {q, rod::StrainVector::Zero(size())});
  return coordinates_.gather(K_.cwiseProduct(full.q));
}

double HeldBody::kinetic_energy(const Twist& V, const Matrix3d& R_WO) const {
  const Vector3d w_O = R_WO.transpose() * V.angular;
  return 0.5 * body_.mass * V.linear.squaredNorm() + 0.5 * w_O.dot(body_.inertia_O * w_O);
}

}  // namespace spring_workbench::dynamics
