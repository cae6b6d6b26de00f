#include "modal_decomposition.h"

#include <Eigen/Cholesky>

#include "constants.h"
#include "spring_workbench/exponential/real_modes.h"
#include "spring_workbench/math/so3.h"
#include "spring_workbench/math/symmetric_modes.h"
#include "spring_workbench/rod/difference_steps.h"

namespace spring_workbench::dynamics {
namespace {

/// M⁻¹ times the stiffness of springs and loads together: −∂q̈/∂q at rest, by central differences (exact for springs).
rod::StrainMatrix stiffness_at_rest(const HeldBody& body, const HandleState& handle, const rod::StrainVector& q) {
  rod::StrainMatrix stiffness(q.size(), q.size());
  const rod::StrainVector rest = 0.0 * q, moved = rod::difference_steps(frozen_difference * body.units(), q);
  for (int j = 0; j < q.size(); ++j) {
    rod::StrainVector up = q, down = q;
    up[j] += moved[j];
    down[j] -= moved[j];
    stiffness.col(j) =
        (body.acceleration(handle, down, rest) - body.acceleration(handle, up, rest)) / (up[j] - down[j]);
  }
  return stiffness;
}

/// Sets the accelerations by a wrench and by the handle's.
void set_forces(const HeldBody& body, double t, const rod::StrainVector& q, ModalDecomposition& part) {
  part.by_wrench = part.inverse_mass * body.object_jacobian(t, q).transpose();
  HandleState at_origin;
  at_origin.t = t;
  const RigidTransform X_HO = body.object(at_origin, {q, rod::StrainVector::Zero(q.size())}).X;
  Matrix6d inertia = Matrix6d::Zero();  // of the object; columns: motions of the handle
  inertia.topLeftCorner<3, 3>().diagonal().setConstant(body.body().mass);
  inertia.topRightCorner<3, 3>() = -body.body().mass * math::skew(X_HO.translation());
  inertia.bottomRightCorner<3, 3>() = X_HO.linear() * body.body().inertia_O * X_HO.linear().transpose();
  part.by_handle = -part.by_wrench * inertia;
}

}  // namespace

ModalDecomposition modal_decomposition(const HeldBody& body, const HandleState& handle, const rod::StrainVector& q) {
  const int n = body.size(), count = 2 * n;
  ModalDecomposition part;
  part.q_reference = q;
  const rod::StrainMatrix M = body.mass_matrix(handle.t, q);
  part.mass = M.diagonal();
  part.inverse_mass = M.llt().solve(rod::StrainMatrix::Identity(n, n));
  set_forces(body, handle.t, q, part);
  part.stiffness = stiffness_at_rest(body, handle, q);

  // First the undamped modes of the springs: if their displacements are scaled by their frequencies, stiff and soft
  // modes can be combined without loss of digits.
  const HeldBody::Springs springs = body.springs(handle, q);
  const math::SymmetricModes undamped = math::symmetric_modes(springs.K, M);
  const rod::StrainMatrix& shapes = undamped.vectors;
  const rod::StrainMatrix to_shapes = part.to_undamped = shapes.transpose() * M;
  // A free mode has only one eigenvector, and those of several free modes are arbitrary: the frozen part gets the
  // stiffness of 1, 2, … rad/s, and the nonlinear residual takes it back.
  const rod::StrainVector smallest = rod::StrainVector::LinSpaced(n, 1.0, n).cwiseAbs2();
  const rod::StrainVector scale = undamped.values.cwiseMax(smallest).cwiseSqrt();
  part.amplitude_rates =
      (scale.cwiseAbs2() + (shapes.transpose() * springs.D * shapes).diagonal().cwiseAbs2()).cwiseSqrt();
  const rod::StrainVector missing = (smallest - undamped.values).cwiseMax(0.0);
  part.stiffness += shapes * missing.asDiagonal() * to_shapes;
  const rod::StrainMatrix modal_stiffness = to_shapes * part.stiffness * shapes;

  part.damping = part.inverse_mass * springs.D;
  ModalDecomposition::ModeMatrix A = ModalDecomposition::ModeMatrix::Zero(count, count);
  A.topRightCorner(n, n).diagonal() = scale;
  A.bottomLeftCorner(n, n) = -(modal_stiffness * scale.cwiseInverse().asDiagonal());
  A.bottomRightCorner(n, n) = -(to_shapes * part.damping * shapes);
  const exponential::RealModes modes(A);
  part.rates = modes.rates;
  part.fastest = modes.rates.fastest();

  part.from_modes.resize(count, count);
  part.from_modes.topRows(n) = shapes * scale.cwiseInverse().asDiagonal() * modes.vectors.topRows(n);
  part.from_modes.bottomRows(n) = shapes * modes.vectors.bottomRows(n);
  part.to_modes.resize(count, count);
  part.to_modes.leftCols(n) = modes.inverse.leftCols(n) * (scale.asDiagonal() * to_shapes);
  part.to_modes.rightCols(n) = modes.inverse.rightCols(n) * to_shapes;
  return part;
}

}  // namespace spring_workbench::dynamics
