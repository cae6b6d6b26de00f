// The method for any equation of motion: here for a pendulum.
#include "spring_workbench/exponential/collocation_step.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <string>

#include "spring_workbench/exponential/real_modes.h"
#include "support/matrix_exponential.h"

namespace spring_workbench::exponential::collocation_step_test {
namespace {

constexpr double omega = 3.0, damping = 0.4;

/// The linear part of θ̈ = −ω² θ − d θ̇ + …
struct Decomposition {
  using Matrix1 = Eigen::Matrix<double, 1, 1>;
  Matrix1 stiffness = Matrix1::Zero(), damping = Matrix1::Zero();
  Eigen::Matrix2d to_modes = Eigen::Matrix2d::Zero(), from_modes = Eigen::Matrix2d::Zero();
  std::array<GeneralComplex, 2> rates;
  int pairs = 0;

  Decomposition() = default;
  Decomposition(double k, double d) {
    stiffness(0, 0) = k;
    damping(0, 0) = d;
    Eigen::Matrix2d A;
    A << 0.0, 1.0, -k, -d;
    const RealModes<Eigen::Matrix2d> modes(A);
    from_modes = modes.vectors;
    to_modes = modes.inverse;
    rates = {modes.rates[0], modes.rates[1]};
    pairs = modes.pairs;
  }
  void exchange(math::StateArchive& state) { state(stiffness, damping, to_modes, from_modes, rates, pairs); }
};

/// A pendulum under a force along its path: θ̈ = −ω² s(θ) − d θ̇ + force(t), s = sin, or the identity if it is linear.
struct Pendulum {
  using ModalDecomposition = Decomposition;
  using Input = double (*)(double t);
  using Forcing = math::Pack;
  using Strain = Eigen::Matrix<double, 1, 1>;
  using NodeStrains = std::array<math::Pack, 1>;
  bool linear;

  double pull(double q) const { return linear ? q : std::sin(q); }
  math::Pack forcing(Input force, const math::Pack& t) const {
    return math::Pack{force(t[0]), force(t[1]), force(t[2]), force(t[3])};
  }
  void acceleration(const math::Pack& force, const math::Pack* q, const math::Pack* q_dot, math::Pack* q_ddot) const {
    for (int i = 0; i < math::pack_size; ++i) (*q_ddot)[i] = -omega * omega * pull((*q)[i]) + force[i];
    *q_ddot -= damping * *q_dot;
  }
  Strain acceleration(Input force, double t, const Strain& q, const Strain& q_dot) const {
    return Strain(-omega * omega * pull(q[0]) - damping * q_dot[0] + force(t));
  }
  NodeStrains by_forcing(const math::Pack& force, const Decomposition&) const { return {force}; }
  double squared_rounding(const math::Pack&, const Decomposition&, double h, const Strain& q,
                          const Strain& q_dot) const {
    return q.squaredNorm() + h * h * q_dot.squaredNorm();
  }
  template <typename Part>
  Strain cancelling(const Part&, const Strain& q, const Strain&) const {
    return Strain(omega * omega * std::abs(q[0]));
  }
};

using Steps = CollocationStep<1, Pendulum>;

Eigen::Vector2d run(const Pendulum& pendulum, const Decomposition& part, Pendulum::Input force, double duration,
                    int count, Eigen::Vector2d state) {
  Steps steps;
  steps.set(part);
  Steps::Strain q(state[0]), q_dot(state[1]);
  const double h = duration / count;
  for (int i = 0; i < count; ++i) {
    const Steps::Result result = steps.step(pendulum, force, i * h, h, q, q_dot);
    EXPECT_TRUE(result.solved) << i;
  }
  return {q[0], q_dot[0]};
}

double smooth(double t) { return std::sin(2.0 * t); }
double cubic(double t) { return 1.0 + t * (2.0 + t * (-3.0 + t)); }

/// A linear equation is solved exactly if its forcing is a cubic in each step, with one step or many.
TEST(CollocationStep, IsExactForALinearEquationUnderACubic) {
  constexpr double duration = 1.3;
  test_support::LongMatrix A = test_support::LongMatrix::Zero(6, 6);  // of θ, θ̇, and 1, t, t², t³
  A(0, 1) = 1.0L;
  A.row(1) << -omega * omega, -damping, 1.0L, 2.0L, -3.0L, 1.0L;
  for (int k = 1; k < 4; ++k) A(2 + k, 1 + k) = k;
  const test_support::LongMatrix to_end = test_support::exponential(A * static_cast<long double>(duration));
  const Eigen::Vector2d begin(0.3, -0.2);
  const Eigen::Vector2d exact =
      (to_end.topLeftCorner(2, 2).cast<double>() * begin + to_end.block(0, 2, 2, 1).cast<double>());
  for (const int count : {1, 7, 100}) {
    const Eigen::Vector2d end = run({true}, Decomposition(omega * omega, damping), cubic, duration, count, begin);
    EXPECT_LT((end - exact).norm(), 1e-14 * count + 4e-15) << count;
  }
}

/// Whatever part of the equation is frozen as its linear part, the order is seven, and the solution the same.
TEST(CollocationStep, HasOrderSevenWithAnyLinearPart) {
  const Eigen::Vector2d begin(1.5, 0.0);
  const Eigen::Vector2d exact = run({false}, Decomposition(omega * omega, damping), smooth, 1.0, 400, begin);
  const std::array<Decomposition, 4> parts{Decomposition(omega * omega, damping), Decomposition(1.0, 0.0),
                                           Decomposition(4.0, 4.0), Decomposition(2.0 * omega * omega, 1.0)};
  for (const Decomposition& part : parts) {
    const double coarse = (run({false}, part, smooth, 1.0, 8, begin) - exact).norm(),
                 fine = (run({false}, part, smooth, 1.0, 16, begin) - exact).norm();
    EXPECT_GT(std::log2(coarse / fine), 6.5) << part.stiffness << " " << coarse << " " << fine;
    EXPECT_LT(fine, 1e-8) << part.stiffness;
    EXPECT_LT((run({false}, part, smooth, 1.0, 200, begin) - exact).norm(), 2e-11) << part.stiffness;
  }
}

/// A step from a restored history is bit-identical with that from the history itself.
TEST(CollocationStep, ContinuesBitIdenticallyFromARestoredHistory) {
  const Pendulum pendulum{false};
  Steps steps, restored;
  steps.set(Decomposition(omega * omega, damping));
  Steps::Strain q(1.0), q_dot(0.0);
  const double h = 0.05;
  for (int i = 0; i < 10; ++i) {
    math::StateArchive saved;
    saved(steps);
    const math::StateArchive::Words words = saved.taken();
    math::StateArchive given(words);
    given(restored);
    EXPECT_TRUE(given.at_end());
    Steps::Strain other_q = q, other_q_dot = q_dot;
    const Steps::Result result = steps.step(pendulum, smooth, i * h, h, q, q_dot),
                        other = restored.step(pendulum, smooth, i * h, h, other_q, other_q_dot);
    EXPECT_EQ(q, other_q) << i;
    EXPECT_EQ(q_dot, other_q_dot) << i;
    EXPECT_EQ(result.error, other.error) << i;
  }
}

}  // namespace
}  // namespace spring_workbench::exponential::collocation_step_test
