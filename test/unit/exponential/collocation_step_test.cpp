// The method for any equation of motion: here for a pendulum.
#include "spring_workbench/exponential/collocation_step.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <string>
#include <tuple>

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
  ModalRates rates;

  Decomposition() = default;
  Decomposition(double k, double d) {
    stiffness(0, 0) = k;
    damping(0, 0) = d;
    Eigen::Matrix2d A;
    A << 0.0, 1.0, -k, -d;
    const RealModes modes(A);
    from_modes = modes.vectors;
    to_modes = modes.inverse;
    rates = modes.rates;
  }
  void archive(math::StateArchive& state) { state(stiffness, damping, to_modes, from_modes, rates); }
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

TEST(Collocation, IntegratesPolynomialsOfDegreeSix) {
  for (int degree = 0; degree < 8; ++degree) {
    double sum = 0.0;
    for (std::size_t i = 0; i < Collocation::count; ++i) {
      sum += Collocation::quadrature[i] * std::pow(Collocation::nodes[i], degree);
    }
    const double error = std::abs(sum - 1.0 / (degree + 1));
    EXPECT_EQ(error < 1e-15, degree < 7) << degree << " " << error;
  }
}

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

/// The linear equation q̈ = −S q − D q̇ + force(t) of three coordinates.
struct Coupled {
  using Square = Eigen::Matrix3d;
  struct ModalDecomposition {
    Square stiffness = Square::Zero(), damping = Square::Zero();
    Eigen::Matrix<double, 6, 6> to_modes, from_modes;
    ModalRates rates;
    void archive(math::StateArchive& state) { state(stiffness, damping, to_modes, from_modes, rates); }
  };
  using Input = double (*)(double t);
  using Forcing = math::Pack;
  using Strain = Eigen::Vector3d;
  using NodeStrains = std::array<math::Pack, 3>;
  Square S, D;

  Eigen::Matrix<double, 6, 6> matrix() const {
    Eigen::Matrix<double, 6, 6> A;
    A << Square::Zero(), Square::Identity(), -S, -D;
    return A;
  }
  ModalDecomposition decomposition() const {
    const RealModes modes(matrix());
    return {S, D, modes.inverse, modes.vectors, modes.rates};
  }
  math::Pack forcing(Input force, const math::Pack& t) const {
    return math::Pack{force(t[0]), force(t[1]), force(t[2]), force(t[3])};
  }
  void acceleration(const math::Pack& force, const math::Pack* q, const math::Pack* q_dot, math::Pack* q_ddot) const {
    for (int i = 0; i < 3; ++i) {
      q_ddot[i] = force;
      for (int j = 0; j < 3; ++j) q_ddot[i] -= S(i, j) * q[j] + D(i, j) * q_dot[j];
    }
  }
  Strain acceleration(Input force, double t, const Strain& q, const Strain& q_dot) const {
    return Strain::Constant(force(t)) - S * q - D * q_dot;
  }
  NodeStrains by_forcing(const math::Pack& force, const ModalDecomposition&) const { return {force, force, force}; }
  double squared_rounding(const math::Pack&, const ModalDecomposition&, double h, const Strain& q,
                          const Strain& q_dot) const {
    return q.squaredNorm() + h * h * q_dot.squaredNorm();
  }
  template <typename Part>
  Strain cancelling(const Part&, const Strain& q, const Strain& q_dot) const {
    return S.cwiseAbs() * q.cwiseAbs() + D.cwiseAbs() * q_dot.cwiseAbs();
  }
};

/// Three coupled oscillators at relative distances of 1e-12 to 0.1 from critical damping, on both sides of it. The
/// rates of `alike` ones cannot be separated; the others form pairs.
Coupled near_critical(bool alike, double apart) {
  Eigen::Matrix3d mixed;
  mixed << 1.0, 0.3, -0.2, 0.1, 1.2, 0.4, -0.3, 0.2, 0.9;
  const Eigen::Vector3d rates = alike ? Eigen::Vector3d::Constant(omega) : Eigen::Vector3d(omega, 7.0, 11.0);
  Coupled equation;
  equation.S = rates.cwiseAbs2().asDiagonal();
  equation.S(1, 0) = equation.S(2, 1) = 2.0;
  equation.S = mixed * equation.S * mixed.inverse();
  equation.D = mixed * (2.0 * (1.0 + apart) * rates).asDiagonal() * mixed.inverse();
  return equation;
}

class NearCritical : public testing::TestWithParam<std::tuple<bool, double>> {
 protected:
  const Coupled equation = near_critical(std::get<0>(GetParam()), std::get<1>(GetParam()));
  const Coupled::ModalDecomposition part = equation.decomposition();
  CollocationStep<3, Coupled> steps;
  static constexpr double duration = 0.8;
};

/// So the solution is continuous where oscillation begins.
TEST_P(NearCritical, CoupledOscillatorsUnderACubicAreExact) {
  test_support::LongMatrix A = test_support::LongMatrix::Zero(10, 10);  // of q, q̇, and 1, t, t², t³
  A.topLeftCorner(6, 6) = equation.matrix().cast<long double>();
  for (int i = 3; i < 6; ++i) A.row(i).tail(4) << 1.0L, 2.0L, -3.0L, 1.0L;
  for (int k = 1; k < 4; ++k) A(6 + k, 5 + k) = k;
  Eigen::Matrix<long double, 10, 1> begin;
  begin << 0.3L, -0.1L, 0.2L, -0.2L, 0.5L, 0.0L, 1.0L, 0.0L, 0.0L, 0.0L;
  const Eigen::Matrix<double, 10, 1> exact =
      (test_support::exponential(A * static_cast<long double>(duration)) * begin).cast<double>();
  for (const int count : {1, 7, 100}) {
    steps.set(part);
    Eigen::Vector3d q = begin.head<3>().cast<double>(), q_dot = begin.segment<3>(3).cast<double>();
    const double h = duration / count;
    for (int i = 0; i < count; ++i) EXPECT_TRUE(steps.step(equation, cubic, i * h, h, q, q_dot).solved) << i;
    EXPECT_LT((q - exact.head<3>()).norm(), 1e-13) << count;
    EXPECT_LT((q_dot - exact.segment<3>(3)).norm(), 1e-12) << count;
  }
}

TEST_P(NearCritical, CoupledOscillatorsRespondAndCarryDeviationsExactly) {
  steps.set(part);
  steps.prepare(duration);
  const Eigen::MatrixXd to_end =
      test_support::exponential(equation.matrix().cast<long double>() * static_cast<long double>(duration))
          .cast<double>();
  const Eigen::MatrixXd response =
      (equation.matrix().inverse() * (to_end - Eigen::MatrixXd::Identity(6, 6))).rightCols(3);
  EXPECT_LT((steps.propagator().response(Eigen::Matrix3d::Identity()) - response).norm(), 1e-13);
  for (int i = 0; i < 6; ++i) {
    const Eigen::Matrix<double, 6, 1> one = Eigen::Matrix<double, 6, 1>::Unit(i);
    EXPECT_LT((steps.propagator().carried(one) - to_end.col(i)).norm(), 1e-12) << i;
  }
}

TEST_P(NearCritical, OscillatorsFormAClusterOnlyIfTheyAreAlike) {
  const auto [alike, apart] = GetParam();
  EXPECT_EQ(part.rates.clusters.rows(), alike ? 6 : 0);
}

INSTANTIATE_TEST_SUITE_P(CollocationStep, NearCritical,
                         testing::Combine(testing::Bool(), testing::Values(0.0, 1e-12, -1e-12, 1e-9, -1e-9, 1e-6, -1e-6,
                                                                           1e-4, -1e-4, 1e-2, -1e-2, 0.1, -0.1)));

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

/// More lengths than are kept, again and again, in no order.
double length_of(int step) { return 0.05 / (1.0 + step * step % 11 % 7); }

/// Each step takes the operators of its own length.
TEST(CollocationStep, OfAnyLengthsInTurnAreExact) {
  const Decomposition part(omega * omega, damping);
  Steps steps;
  steps.set(part);
  Steps::Strain q(1.5), q_dot(0.3);
  double t = 0.0;
  for (int i = 0; i < 60; ++i) {
    EXPECT_TRUE(steps.step({true}, cubic, t, length_of(i), q, q_dot).solved) << i;
    t += length_of(i);
  }
  const Eigen::Vector2d whole = run({true}, part, cubic, t, 1, {1.5, 0.3});
  EXPECT_LT((Eigen::Vector2d(q[0], q_dot[0]) - whole).norm(), 1e-13);
}

/// A step from a restored history is bit-identical with that from the history itself.
TEST(CollocationStep, ContinuesBitIdenticallyFromARestoredHistory) {
  const Pendulum pendulum{false};
  Steps steps, restored;
  steps.set(Decomposition(omega * omega, damping));
  Steps::Strain q(1.0), q_dot(0.0);
  double t = 0.0;
  for (int i = 0; i < 60; ++i) {
    const double h = length_of(i);
    math::StateArchive saved;
    saved(steps);
    const math::StateArchive::Words words = saved.words();
    math::StateArchive given(words);
    given(restored);
    EXPECT_TRUE(given.at_end());
    Steps::Strain other_q = q, other_q_dot = q_dot;
    const Steps::Result result = steps.step(pendulum, smooth, t, h, q, q_dot),
                        other = restored.step(pendulum, smooth, t, h, other_q, other_q_dot);
    t += h;
    EXPECT_EQ(q, other_q) << i;
    EXPECT_EQ(q_dot, other_q_dot) << i;
    EXPECT_EQ(result.error, other.error) << i;
  }
}

}  // namespace
}  // namespace spring_workbench::exponential::collocation_step_test
