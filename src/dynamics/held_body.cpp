#include "spring_workbench/dynamics/held_body.h"

#include <cmath>

#include "spring_workbench/rod/modal_damping.h"
#include "spring_workbench/rod/straight_rod.h"

namespace spring_workbench::dynamics {

HeldBody::HeldBody(std::shared_ptr<const rod::ShapeModel> shape, const BodyInertia& body, double gravity)
    : shape_(std::move(shape)), straight_(*shape_), body_(body), gravity_(gravity), coordinates_(shape_->size()) {
  p_OE_ = body.X_OE.translation();
  p_EO_ = -(body.X_OE.linear().transpose() * p_OE_);
  R_EO_ = body.X_OE.linear().transpose();
  K_ = D_ = rod::StrainVector::Zero(coordinates_.count());
  changed();
}

void HeldBody::changed() {
  ++version_;
  derive();
}

void HeldBody::archive(math::StateArchive& state) {
  state(version_, load_version_, stiffness_, damping_, K_, D_, modal_, modal_ratio_, coordinates_, load_W_, loaded_,
        couplings_);
  if (state.is_restoring()) derive();
}

void HeldBody::derive() {
  bends_ = !coordinates_.is_off(shape_->bend());
  last_tip_.known = false;
  if (!modal_) return;
  const rod::StrainVector zero = rod::StrainVector::Zero(coordinates_.count());
  Matrix3d I_H;
  D_modal_ = rod::modal_damping(mass_matrix(kinematics({zero, zero}), I_H), stiffness(), modal_ratio_);
}

double HeldBody::axial_inertia() const {
  const Vector3d axis = body_.X_OE.linear().col(2);
  return axis.dot(body_.inertia_O * axis) + body_.mass * axis.cross(p_OE_).squaredNorm();
}

rod::PerDof HeldBody::damping_of(const rod::PerDof& stiffness, const rod::PerDof& ratio) const {
  const auto c = [](double inertia, double k, double zeta) { return 2.0 * zeta * std::sqrt(inertia * k); };
  return {c(body_.mass, stiffness.stretch, ratio.stretch), c(body_.mass, stiffness.bend, ratio.bend),
          c(axial_inertia(), stiffness.torsion, ratio.torsion)};
}

void HeldBody::set_springs(const rod::PerDof& stiffness, const rod::PerDof& damping_ratio) {
  set_coefficients(stiffness, damping_of(stiffness, damping_ratio));
}

void HeldBody::set_coefficients(const rod::PerDof& stiffness, const rod::PerDof& damping) {
  stiffness_ = stiffness;
  damping_ = damping;
  K_ = shape_->stiffness(stiffness);
  D_ = shape_->damping(damping, stiffness);
  modal_ = false;
  changed();
}

void HeldBody::set_springs_with_modal_damping(const rod::PerDof& stiffness, double damping_ratio) {
  set_coefficients(stiffness, rod::PerDof());
  damping_ = damping_of(stiffness, {damping_ratio, damping_ratio, damping_ratio});
  modal_ = true;
  modal_ratio_ = damping_ratio;
  changed();
}

void HeldBody::set_springs(const rod::ForkSettings& fork) {
  switch (fork.damping_law) {
    case rod::DampingLaw::per_dof:
      return set_springs(fork.stiffness, fork.damping_ratio);
    case rod::DampingLaw::modal:
      return set_springs_with_modal_damping(fork.stiffness, fork.damping_ratio.stretch);
    case rod::DampingLaw::coefficients:
      return set_coefficients(fork.stiffness, fork.damping_coefficient);
  }
}

StrainState HeldBody::zero_state() const { return {rod::StrainVector::Zero(size()), rod::StrainVector::Zero(size())}; }

rod::StrainVector HeldBody::stiffness() const { return coordinates_.gather(K_); }

rod::StrainMatrix HeldBody::damping() const {
  return modal_ ? D_modal_ : rod::StrainMatrix(coordinates_.gather(D_).asDiagonal());
}

void HeldBody::attach(const std::vector<Attached>& couplings) {
  if (couplings_.attach(couplings)) ++version_;
}

HeldBody::Springs HeldBody::springs(const HandleState& h, const rod::StrainVector& q) const {
  Springs all{stiffness().asDiagonal(), damping()};
  if (!coupled()) return all;
  const Coupling::Springs more = read_couplings(h, {q, rod::StrainVector::Zero(size())}).springs;
  const auto J = object_jacobian(h.t, q);
  all.K += J.transpose() * more.stiffness * J;
  all.D += J.transpose() * more.damping * J;
  return all;
}

StrainState HeldBody::set_dofs(const rod::ForkDofs& dofs, double t, double return_time, const StrainState& full) {
  coordinates_.set(shape_->bend(), dofs.bend, t, return_time, full);
  coordinates_.set(shape_->torsion(), dofs.torsion, t, return_time, full);
  coordinates_.set(shape_->stretch(), dofs.stretch, t, return_time, full);
  changed();
  return {coordinates_.gather(full.q), coordinates_.gather(full.q_dot)};
}

bool HeldBody::drop_finished_returns(double t) {
  const bool dropped = coordinates_.drop_finished_returns(t);
  if (dropped) changed();
  return dropped;
}

void HeldBody::set_load(const Wrench& load_W) {
  if (load_W.force == load_W_.force && load_W.moment == load_W_.moment) return;
  load_W_ = load_W;
  loaded_ = !(load_W.force.isZero(0.0) && load_W.moment.isZero(0.0));
  ++load_version_;
}

}  // namespace spring_workbench::dynamics
