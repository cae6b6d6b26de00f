#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <cmath>

#include "integrators.h"
#include "spring_workbench/math/phi_functions.h"

namespace spring_workbench {
namespace {

/// The frozen linear part is taken anew when the strain has moved this far from where it was taken, as a bound on how far
/// the tip's direction has turned [rad] (curvatures times the length).
constexpr double relinearise_after = 0.1;

/// Eigenvectors may be worse conditioned than this only where the damping is critical to the last bit; then the linear part
/// is taken with slightly other damping, and the difference goes to the remainder.
constexpr double worst_condition = 1e5;
constexpr int most_attempts = 6;

}  // namespace

void Exponential::linearise(const HeldBody& body, const HandleForcing& handle, const StrainState& state) {
  n_ = body.size();
  version_ = body.version();
  q_reference_ = state.q;
  step_ = 0.0;
  const StrainMatrix M = body.mass_matrix(handle.t, state.q);
  const Eigen::LLT<StrainMatrix> cholesky(M);
  inverse_mass_ = cholesky.solve(StrainMatrix::Identity(n_, n_));
  const StrainMatrix D = StrainMatrix(body.damping().asDiagonal());

  // Stiffness of springs and loads together: −∂q̈/∂q at rest, by central differences where the springs' own part is linear.
  const StrainVector K = body.stiffness();
  stiffness_.resize(n_, n_);
  const StrainVector rest = StrainVector::Zero(n_);
  for (int j = 0; j < n_; ++j) {
    const double moved = 1e-5 * (1.0 / body.shape().length());
    StrainVector up = state.q, down = state.q;
    up[j] += moved;
    down[j] -= moved;
    stiffness_.col(j) =
        (body.acceleration(handle, down, rest) - body.acceleration(handle, up, rest)) / (2.0 * moved);
  }

  // Undamped modes of the springs first: in them, with displacements scaled by their frequencies, stiff and soft motions
  // stand side by side without loss of digits.
  const Eigen::GeneralizedSelfAdjointEigenSolver<StrainMatrix> undamped(StrainMatrix(K.asDiagonal()), M);
  const StrainMatrix shapes = undamped.eigenvectors();
  const StrainMatrix to_shapes = shapes.transpose() * M;
  const StrainVector scale = undamped.eigenvalues().cwiseMax(1.0).cwiseSqrt();
  // A free mode has no two eigenvectors: the frozen part gets the stiffness of 1 rad/s, and the rest takes it back.
  const StrainVector missing = (1.0 - undamped.eigenvalues().array()).cwiseMax(0.0);
  stiffness_ += shapes * missing.asDiagonal() * to_shapes;
  const StrainMatrix modal_stiffness = to_shapes * stiffness_ * shapes;

  using ModeMatrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, most_modes, most_modes>;
  Eigen::EigenSolver<ModeMatrix> solver(2 * n_);
  // In real columns, a conjugate pair as its real and imaginary part: so V⁻¹ is that of what is kept of the pair, with no
  // more error than its condition makes; of two complex rows that only rounding tells apart, one alone is worth nothing.
  ModeMatrix V(2 * n_, 2 * n_), V_inverse;
  double off_critical = 0.0;
  for (int attempt = 0; attempt < most_attempts; ++attempt) {
    damping_ = inverse_mass_ * D;
    for (int i = 0; i < n_; ++i) damping_.col(i) *= 1.0 + off_critical * (i + 1);
    const StrainMatrix modal_damping = to_shapes * damping_ * shapes;
    ModeMatrix A = ModeMatrix::Zero(2 * n_, 2 * n_);
    A.topRightCorner(n_, n_).diagonal() = scale;
    A.bottomLeftCorner(n_, n_) = -(modal_stiffness * scale.cwiseInverse().asDiagonal());
    A.bottomRightCorner(n_, n_) = -modal_damping;
    solver.compute(A);
    const FromModes vectors = solver.eigenvectors();
    for (int m = 0; m < 2 * n_; ++m) {
      if (solver.eigenvalues()[m].imag() < 0.0) {
        V.col(m) = vectors.col(m - 1).imag();
      } else {
        V.col(m) = vectors.col(m).real();
      }
    }
    V_inverse = V.partialPivLu().inverse();
    if (V.norm() * V_inverse.norm() < worst_condition) break;
    off_critical = off_critical == 0.0 ? 1e-8 : 10.0 * off_critical;
  }

  // Keep the real modes and one of each conjugate pair, in the coordinates themselves.
  const ModeMatrix from = [&] {
    ModeMatrix m(2 * n_, 2 * n_);
    m.topRows(n_) = shapes * scale.cwiseInverse().asDiagonal() * V.topRows(n_);
    m.bottomRows(n_) = shapes * V.bottomRows(n_);
    return m;
  }();
  const ModeMatrix to = [&] {
    ModeMatrix m(2 * n_, 2 * n_);
    m.leftCols(n_) = V_inverse.leftCols(n_) * (scale.asDiagonal() * to_shapes);
    m.rightCols(n_) = V_inverse.rightCols(n_) * to_shapes;
    return m;
  }();
  const auto values = solver.eigenvalues();
  fastest_ = values.cwiseAbs().maxCoeff();
  rates_.resize(2 * n_);
  to_modes_.resize(2 * n_, 2 * n_);
  from_modes_.resize(2 * n_, 2 * n_);
  int kept = 0;
  for (int m = 0; m < 2 * n_; ++m) {
    if (values[m].imag() < 0.0) continue;
    rates_[kept] = values[m];
    const bool pair = values[m].imag() > 0.0;
    from_modes_.col(kept) = from.col(m).cast<Complex>();
    to_modes_.row(kept) = to.row(m).cast<Complex>();
    if (pair) {
      from_modes_.col(kept) += Complex(0.0, 1.0) * from.col(m + 1);
      to_modes_.row(kept) -= Complex(0.0, 1.0) * to.row(m + 1);
    }
    ++kept;
  }
  rates_.conservativeResize(kept);
  to_modes_.conservativeResize(kept, 2 * n_);
  from_modes_.conservativeResize(2 * n_, kept);
}

void Exponential::prepare(double h) {
  step_ = h;
  for (int m = 0; m < rates_.size(); ++m) {
    const PhiFunctions half = phi_functions(0.5 * h * rates_[m]);
    const PhiFunctions whole = phi_functions(h * rates_[m]);
    mode_step_[static_cast<std::size_t>(m)] = {half.zero,  h * half.one,  h * half.two, whole.zero,
                                               h * whole.one, h * whole.two, h * whole.three};
  }
}

void Exponential::to_modes(const StrainState& state, ModeVector& z) const {
  z = to_modes_.leftCols(n_) * state.q + to_modes_.rightCols(n_) * state.q_dot;
}

void Exponential::from_modes(const ModeVector& z, StrainState& state) const {
  state.q = (from_modes_.topRows(n_) * z).real();
  state.q_dot = (from_modes_.bottomRows(n_) * z).real();
}

Exponential::ModeVector Exponential::remainder(const StrainVector& q_ddot, const StrainState& state) const {
  return to_modes_.rightCols(n_) * StrainVector(q_ddot + stiffness_ * (state.q - q_reference_) + damping_ * state.q_dot);
}

StepEstimate Exponential::step(const HeldBody& body, const MotionSegment& handle, double t, double h,
                               StrainState& state) {
  const HandleForcing begin = body.forcing(handle, t);
  const HandleForcing middle = body.forcing(handle, t + 0.5 * h);
  const HandleForcing end = body.forcing(handle, t + h);
  if (version_ != body.version() || n_ != body.size() ||
      (state.q - q_reference_).norm() * body.shape().length() > relinearise_after) {
    linearise(body, begin, state);
  }
  if (h != step_) prepare(h);

  // The modes are those of the strain about the reference: z = V⁻¹ (q − q_ref, q̇).
  ModeVector z, u(rates_.size());
  to_modes({state.q - q_reference_, state.q_dot}, z);
  StrainState stage;
  const auto at_stage = [&]() {
    from_modes(u, stage);
    stage.q += q_reference_;
  };
  const auto modes = static_cast<std::size_t>(rates_.size());
  const auto at = [](std::size_t m) { return static_cast<Eigen::Index>(m); };

  const ModeVector n1 = remainder(last_.get(body, begin, state), state);
  for (std::size_t m = 0; m < modes; ++m) {
    const ModeStep& s = mode_step_[m];
    u[at(m)] = s.half_decay * z[at(m)] + 0.5 * s.half_1 * n1[at(m)];
  }
  at_stage();
  const ModeVector n2 = remainder(body.acceleration(middle, stage.q, stage.q_dot), stage);
  for (std::size_t m = 0; m < modes; ++m) {
    const ModeStep& s = mode_step_[m];
    u[at(m)] = s.half_decay * z[at(m)] + 0.5 * s.half_1 * n1[at(m)] + s.half_2 * (n2[at(m)] - n1[at(m)]);
  }
  at_stage();
  const ModeVector n3 = remainder(body.acceleration(middle, stage.q, stage.q_dot), stage);
  for (std::size_t m = 0; m < modes; ++m) {
    const ModeStep& s = mode_step_[m];
    u[at(m)] = s.decay * z[at(m)] + s.one * n1[at(m)] + 2.0 * s.two * (n3[at(m)] - n1[at(m)]);
  }
  at_stage();
  const ModeVector n4 = remainder(body.acceleration(end, stage.q, stage.q_dot), stage);
  for (std::size_t m = 0; m < modes; ++m) {
    const ModeStep& s = mode_step_[m];
    const Eigen::Index i = at(m);
    u[i] = s.decay * z[i] + s.one * n1[i] + s.two * (-3.0 * n1[i] + 2.0 * (n2[i] + n3[i]) - n4[i]) +
           4.0 * s.three * (n1[i] - n2[i] - n3[i] + n4[i]);
  }
  at_stage();
  state = stage;

  // Against the scheme that ends in the remainder of the new state.
  const StrainVector q_ddot = body.acceleration(end, state.q, state.q_dot);
  last_.keep(body, end, state, q_ddot);
  const ModeVector n5 = remainder(q_ddot, state);
  for (std::size_t m = 0; m < modes; ++m) {
    const ModeStep& s = mode_step_[m];
    u[at(m)] = (4.0 * s.three - s.two) * (n5[at(m)] - n4[at(m)]);
  }
  from_modes(u, stage);
  return {stage.q, fastest_ * h, stage.q_dot};
}

Integrator::Response Exponential::response(const HeldBody& body, double t, double h, const StrainState& state) {
  if (version_ != body.version() || n_ != body.size()) return Integrator::response(body, t, h, state);
  if (h != step_) prepare(h);
  FromModes weighted = to_modes_.rightCols(n_);
  for (int m = 0; m < rates_.size(); ++m) weighted.row(m) *= mode_step_[static_cast<std::size_t>(m)].one;
  Response r;
  r.q = (from_modes_.topRows(n_) * weighted).real() * inverse_mass_;
  r.q_dot = (from_modes_.bottomRows(n_) * weighted).real() * inverse_mass_;
  return r;
}

}  // namespace spring_workbench
