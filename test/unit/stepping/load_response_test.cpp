#include "spring_workbench/stepping/load_response.h"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <cmath>
#include <memory>
#include <optional>
#include <random>
#include <string>
#include <vector>

#include "support/named.h"

namespace spring_workbench::stepping::load_response_test {
namespace {

using namespace dynamics;

/// A random fork within its range, usually strongly bent, after a short step.
struct Case {
  explicit Case(unsigned seed) : random(seed) {
    const std::string shape = std::vector<std::string>{"linear", "constant", "bushing"}[seed % 3];
    integrator = make_integrator(seed % 2 == 0 ? IntegratorKind::exponential : IntegratorKind::rosenbrock);
    BodyInertia body;
    body.mass = std::pow(10.0, 3.0 * unit());
    body.inertia_O = body.mass * Vector3d(0.001, 0.003, 0.004).asDiagonal().toDenseMatrix();
    body.X_OE.translation() << 0.08, 0.0, 0.0;
    held.emplace(rod::make_shape_model(test_support::shape_named(shape), 0.2), body, 9.81);
    const double k = std::pow(10.0, 3.0 + 3.0 * unit()), zeta = seed % 5 == 0 ? 0.0 : 1.0;
    held->set_springs({k, 0.4 * k, 0.004 * k}, {zeta, zeta, zeta});
    h = std::pow(10.0, -3.5 + 1.5 * unit());
    const StrainState begin = somewhere();
    state = begin;
    integrator->step(*held, hand, 0.0, h, state);
    if (!admissible()) state = begin;
    end = held->state_at(hand, h);
  }
  double unit() { return std::uniform_real_distribution<double>(-1.0, 1.0)(random); }
  bool admissible() const { return held->shape().admissible(held->full_state(h, state).q); }
  StrainState somewhere() {
    StrainState s = held->zero_state();
    do {
      for (Eigen::Index i = 0; i < s.q.size(); ++i) s.q[i] = unit() * (held->shape().size() == 6 ? 20.0 : 5.0);
    } while (!held->shape().admissible(held->full_state(0.0, s).q));
    return s;
  }
  rod::StrainVector change() {
    rod::StrainVector Q(held->size());
    for (Eigen::Index i = 0; i < Q.size(); ++i) Q[i] = unit() * std::pow(10.0, 3.0 + 3.0 * unit());
    return Q;
  }

  std::mt19937 random;
  std::unique_ptr<Integrator> integrator;
  std::optional<HeldBody> held;
  double h = 0.0;
  motion::MotionSegment hand{RigidTransform::Identity()};
  StrainState state;
  HandleState end;
};

double range_used(const Case& c) { return c.held->shape().range_used(c.held->full_state(c.h, c.state).q); }

TEST(LoadResponse, NothingComesTowardsALoad) {
  for (unsigned seed = 0; seed < 300; ++seed) {
    Case c(seed);
    LoadResponse load_response;
    load_response.begin_step(c.held->size());
    const Integrator::Response r = load_response.response(*c.integrator, *c.held, c.end, c.h, c.state);
    ASSERT_TRUE(r.q.allFinite() && r.q_dot.allFinite()) << seed;
    const rod::StrainMatrix symmetric = 0.5 * (r.q + r.q.transpose());
    EXPECT_GT(Eigen::SelfAdjointEigenSolver<rod::StrainMatrix>(symmetric).eigenvalues().minCoeff(), 0.0) << seed;
  }
}

/// Of a fork that is bent little, linearised where it is: the step again, under another load, ends where the correction
/// puts it.
TEST(LoadResponse, CorrectsTheEndAsAStepUnderTheOtherLoadWould) {
  for (unsigned seed = 0; seed < 100; ++seed) {
    Case c(seed);
    c.integrator = make_integrator(IntegratorKind::exponential);  // whose response is exact
    StrainState begin = c.held->zero_state();
    for (Eigen::Index i = 0; i < begin.q.size(); ++i) begin.q[i] = 1e-3 * c.unit();
    const auto end_under = [&](const Wrench& load_W) {
      StrainState s = begin;
      c.held->set_load(load_W);
      EXPECT_TRUE(c.integrator->step(*c.held, c.hand, 0.0, c.h, s).converged) << seed;
      return s;
    };
    Wrench change_W;
    change_W.force = 0.1 * c.held->body().mass * Vector3d(c.unit(), c.unit(), c.unit());
    change_W.moment = 0.001 * c.held->body().mass * Vector3d(c.unit(), c.unit(), c.unit());
    const StrainState without = end_under({}), with = end_under(change_W);
    LoadResponse load_response;
    load_response.begin_step(c.held->size());
    Vector6d load;
    load << change_W.force, change_W.moment;
    StrainState corrected = without;
    load_response.correct(*c.integrator, *c.held, c.end, c.h,
                          c.held->object_jacobian(c.h, without.q).transpose() * load, corrected);
    EXPECT_EQ(load_response.stops().cols(), 0) << seed;
    EXPECT_LE((corrected.q - with.q).norm(), 0.02 * (with.q - without.q).norm() + 1e-12) << seed;
    EXPECT_LE((corrected.q_dot - with.q_dot).norm(), 0.02 * (with.q_dot - without.q_dot).norm() + 1e-9) << seed;
  }
}

TEST(LoadResponse, AStopThatIsMetHoldsForTheRestOfTheStep) {
  int met = 0;
  for (unsigned seed = 0; seed < 300; ++seed) {
    Case c(seed);
    LoadResponse load_response;
    load_response.begin_step(c.held->size());
    for (int k = 0; k < 5; ++k) {
      load_response.correct(*c.integrator, *c.held, c.end, c.h, c.change(), c.state);
      ASSERT_TRUE(c.state.q.allFinite() && c.state.q_dot.allFinite()) << seed;
      ASSERT_LT(range_used(c), 1.0) << seed;
    }
    const rod::StrainMatrix& stops = load_response.stops();
    ASSERT_LE(stops.cols(), 2) << seed;
    if (stops.cols() == 0) continue;
    ++met;
    const rod::StrainVector Q = c.change();
    const Integrator::Response r = load_response.response(*c.integrator, *c.held, c.end, c.h, c.state);
    const rod::StrainVector way = r.q * Q;
    for (Eigen::Index i = 0; i < stops.cols(); ++i) {
      EXPECT_LE(std::abs(stops.col(i).dot(way)), 1e-9 * stops.col(i).norm() * way.norm()) << seed;
    }
    load_response.begin_step(c.held->size());
    EXPECT_EQ(load_response.stops().cols(), 0);
  }
  EXPECT_GT(met, 100);
}

}  // namespace
}  // namespace spring_workbench::stepping::load_response_test
