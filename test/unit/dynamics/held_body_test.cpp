#include "spring_workbench/dynamics/held_body.h"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <cmath>
#include <random>

#include "spring_workbench/dynamics/integrator.h"
#include "spring_workbench/math/damped_oscillator.h"
#include "spring_workbench/math/so3.h"
#include "support/named.h"

namespace spring_workbench::dynamics::held_body_test {
namespace {

/// A hand that moves on a cubic in position and in rotation vector.
motion::MotionSegment moving_hand(double duration) {
  motion::PoseSample a, b;
  b.t = duration;
  b.X = make_transform(Vector3d(0.1, 0.05, -0.08), Quaterniond(math::exp_so3(Vector3d(0.3, -0.2, 0.5))));
  return motion::MotionSegment(a, Vector3d(0.5, 0.0, -0.3), Vector3d(1.0, 0.5, -2.0), b, Vector3d(-0.2, 0.4, 0.1),
                               Vector3d(0.3, 1.0, 0.5));
}

RigidTransform hanging() {
  // The fork's axis down.
  return make_transform(Vector3d(0.0, 0.0, 1.0), Quaterniond(0.0, 1.0, 0.0, 0.0));
}

BodyInertia box_off_centre() {
  BodyInertia body;
  body.mass = 1.2;
  body.inertia_O = Vector3d(0.004, 0.006, 0.005).asDiagonal();
  body.X_OE = make_transform(Vector3d(0.03, 0.02, -0.05), Quaterniond(math::exp_so3(Vector3d(0.2, 0.1, 0.3))));
  return body;
}

HeldBody held_by(const std::string& shape, const rod::PerDof& k, const rod::PerDof& zeta, const BodyInertia& body,
                 double gravity = 9.81) {
  HeldBody held(rod::make_shape_model(test_support::shape_named(shape), 0.2), body, gravity);
  held.set_springs(k, zeta);
  return held;
}

void only(HeldBody& held, const rod::ForkDofs& dofs) {
  const rod::StrainVector zero = rod::StrainVector::Zero(held.shape().size());
  held.set_dofs(dofs, 0.0, 0.05, {zero, zero});
}

TEST(DampedOscillator, SolvesItsEquationForEveryDamping) {
  for (double zeta : {0.0, 0.1, 0.999999, 1.0, 1.000001, 1.5, 10.0}) {
    for (double omega : {0.0, 1e-4, 1.0, 30.0, 1e4}) {
      for (double t : {1e-6, 1e-3, 0.02, 1.0}) {
        const double alpha = omega > 0.0 ? zeta * omega : zeta;
        const math::OscillatorStep s = math::damped_oscillator(alpha, omega * omega, t);
        // A step is two half steps.
        const math::OscillatorStep h = math::damped_oscillator(alpha, omega * omega, 0.5 * t);
        EXPECT_NEAR(s.xx, h.xx * h.xx + h.xv * h.vx, 1e-11);
        EXPECT_NEAR(s.xv, h.xx * h.xv + h.xv * h.vv, 1e-11 * std::max(t, 1e-3));
        EXPECT_NEAR(s.vv, h.vx * h.xv + h.vv * h.vv, 1e-11);
        EXPECT_NEAR(s.xg, h.xx * h.xg + h.xv * h.vg + h.xg, 1e-10 * t * t);
        // A constant force holds x = g / ω₀² at rest.
        EXPECT_NEAR(s.xx + omega * omega * s.xg, 1.0, 1e-12);
      }
    }
  }
}

TEST(HeldBody, HangingObjectSagsByItsWeightOverTheStiffness) {
  for (const char* name : {"exponential", "paper"}) {
    BodyInertia body = box_off_centre();
    body.mass = 1.0;
    body.X_OE = make_transform(Vector3d(0.0, 0.0, -0.05), Quaterniond::Identity());
    HeldBody held = held_by("linear", {2000.0, 500.0, 5.0}, {1.0, 1.0, 1.0}, body);
    StrainState s = held.zero_state();
    const motion::MotionSegment hand(hanging());
    const auto integrator = test_support::make_integrator(name);
    for (int i = 0; i < 400; ++i) integrator->step(held, hand, 0.02 * i, 0.02, s);
    EXPECT_NEAR(held.shape().extension(s.q), 9.81 / 2000.0, 1e-6 * 9.81 / 2000.0) << name;
  }
}

TEST(HeldBody, StretchAloneIsTheExactOscillatorAtAnyStepAndDamping) {
  for (const char* name : {"exponential", "paper"}) {
    for (double zeta : {0.0, 0.1, 1.0, 3.0, 10.0}) {
      BodyInertia body;
      body.mass = 0.8;
      HeldBody held = held_by("linear", {1500.0, 500.0, 5.0}, {zeta, 1.0, 1.0}, body);
      only(held, {true, false, false});
      StrainState s = held.zero_state();
      const motion::MotionSegment hand(hanging());
      const auto integrator = test_support::make_integrator(name);
      const double h = 0.05, omega = std::sqrt(1500.0 / 0.8);
      double x = 0.0, v = 0.0;
      const math::OscillatorStep exact = math::damped_oscillator(zeta * omega, omega * omega, h);
      for (int i = 0; i < 20; ++i) {
        integrator->step(held, hand, h * i, h, s);
        const double x1 = exact.xx * x + exact.xv * v + exact.xg * 9.81;
        v = exact.vx * x + exact.vv * v + exact.vg * 9.81;
        x = x1;
        EXPECT_NEAR(held.shape().extension(held.full_state(h * i + h, s).q), x, 1e-9) << name << " " << zeta;
      }
    }
  }
}

TEST(HeldBody, NoLagBehindAHandAtConstantVelocity) {
  HeldBody held = held_by("linear", {2000.0, 500.0, 5.0}, {1.0, 1.0, 1.0}, box_off_centre(), 0.0);
  motion::PoseSample a, b;
  b.t = 10.0;
  b.X.translation() << 5.0, 3.0, -2.0;
  const Vector3d v = b.X.translation() / b.t;
  const motion::MotionSegment hand(a, v, Vector3d::Zero(), b, v, Vector3d::Zero());
  for (const std::string& name : test_support::integrator_names()) {
    StrainState s = held.zero_state();
    s.q_dot = held.project_twist(held.state_at(hand, 0.0), s.q, Twist());
    const auto integrator = test_support::make_integrator(name);
    const double h = integrator->stiffly_stable() ? 0.02 : 2e-4;
    for (int i = 0; h * i < 3.0; ++i) integrator->step(held, hand, h * i, h, s);
    EXPECT_LT(s.q.norm(), 1e-9) << name;
  }
}

TEST(HeldBody, ProjectedTwistIsTheObjectsOwnWhereTheForkCanFollow) {
  HeldBody held = held_by("linear", {2000.0, 500.0, 5.0}, {1.0, 1.0, 1.0}, box_off_centre());
  const motion::MotionSegment hand = moving_hand(0.1);
  const HandleState f = held.state_at(hand, 0.03);
  std::mt19937 random(2);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  StrainState s = held.zero_state();
  for (int i = 0; i < s.q.size(); ++i) s.q[i] = 2.0 * uniform(random);
  s.q[5] = 0.05;
  Twist twist;
  twist.linear << 0.3, -0.2, 0.1;
  twist.angular << -1.0, 0.4, 2.0;
  s.q_dot = held.project_twist(f, s.q, twist);
  const motion::MotionState o = held.object(f, s);
  EXPECT_LT((o.velocity.linear - twist.linear).norm(), 1e-12);
  EXPECT_LT((o.velocity.angular - twist.angular).norm(), 1e-11);
}

const std::vector<rod::ForkDofs> families{{true, true, true},  {true, true, false},  {true, false, true},
                                          {false, true, true}, {true, false, false}, {false, true, false},
                                          {false, false, true}};

TEST(HeldBody, ObjectObeysNewtonAndEulerUnderTheRodsWrench) {
  // D'Alembert: inertia, gravity and load balance spring and damper in each coordinate.
  std::mt19937 random(5);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  const motion::MotionSegment hand = moving_hand(0.1);
  for (const std::string& shape : test_support::shape_names()) {
    for (const rod::ForkDofs& dofs : families) {
      for (int trial = 0; trial < 20; ++trial) {
        HeldBody held = held_by(shape, {1000.0, 200.0, 3.0}, {0.1, 0.5, 2.0}, box_off_centre());
        only(held, dofs);
        Wrench load;
        load.force = 5.0 * Vector3d::NullaryExpr([&] { return uniform(random); });
        load.moment = 0.3 * Vector3d::NullaryExpr([&] { return uniform(random); });
        if (trial > 0) held.set_load(load);
        StrainState s = held.zero_state();
        s.q = rod::StrainVector::NullaryExpr(held.size(), [&] { return 0.03 * uniform(random); });
        s.q_dot = rod::StrainVector::NullaryExpr(held.size(), [&] { return uniform(random); });
        const HandleState at = held.state_at(hand, 0.05);
        const rod::StrainVector q_ddot = held.acceleration(at, s.q, s.q_dot);
        const motion::MotionState o = held.object(at, s, &q_ddot);
        const Matrix3d R = o.X.linear(), I_W = R * held.body().inertia_O * R.transpose();
        Eigen::Matrix<double, 6, 1> dynamic;
        dynamic << held.body().mass * (o.acceleration.linear + 9.81 * Vector3d::UnitZ()) - held.load().force,
            I_W * o.acceleration.angular + o.velocity.angular.cross(I_W * o.velocity.angular) - held.load().moment;
        Eigen::Matrix<double, 6, Eigen::Dynamic> J = held.object_jacobian(0.05, s.q);
        J.topRows(3) = at.X_WH.linear() * J.topRows(3);
        J.bottomRows(3) = at.X_WH.linear() * J.bottomRows(3);
        const rod::StrainVector springs = -held.elastic_force(0.05, s.q) - held.damping() * s.q_dot;
        EXPECT_LT((J.transpose() * dynamic - springs).norm(), 1e-10 * (1.0 + springs.norm()))
            << shape << " " << dofs.bend << dofs.torsion << dofs.stretch;
      }
    }
  }
}

TEST(HeldBody, TheElasticForceIsTheSlopeOfTheElasticEnergy) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  for (const std::string& shape : test_support::shape_names()) {
    for (int trial = 0; trial < 10; ++trial) {
      const HeldBody held = held_by(shape, {1000.0, 200.0, 3.0}, {1.0, 1.0, 1.0}, box_off_centre());
      StrainState s = held.zero_state();
      s.q = rod::StrainVector::NullaryExpr(held.size(), [&] { return 0.3 * uniform(random); });
      const rod::StrainVector way = rod::StrainVector::NullaryExpr(held.size(), [&] { return uniform(random); });
      const auto energy = [&](double part) { return held.elastic_energy(0.0, {s.q + part * way, s.q_dot}); };
      const double slope = (energy(1e-4) - energy(-1e-4)) / 2e-4;
      const double scale = held.elastic_force(0.0, s.q).norm() * way.norm();
      EXPECT_NEAR(slope, held.elastic_force(0.0, s.q).dot(way), 1e-6 * scale) << shape;
    }
  }
}

/// Grasps of a long box at its centre, off its centre, at an edge and at a corner, turned, of `mass` [kg].
std::vector<BodyInertia> grasps_of_long_box(double mass) {
  std::vector<BodyInertia> grasps;
  const Vector3d half(0.02, 0.03, 0.15);
  for (const Vector3d& at : {Vector3d(0, 0, 0), Vector3d(0, 0, 0.6), Vector3d(0, 1, 0.9), Vector3d(1, -1, 1)}) {
    for (const Vector3d& turn : {Vector3d(0, 0, 0), Vector3d(1.2, 0.3, -0.5), Vector3d(0.0, 3.1, 0.0)}) {
      const Vector3d squares = half.cwiseAbs2();
      const Vector3d moments = mass / 3.0 * (squares.sum() - squares.array());
      grasps.push_back(
          {mass, moments.asDiagonal(), make_transform(at.cwiseProduct(half), Quaterniond(math::exp_so3(turn)))});
    }
  }
  return grasps;
}

TEST(HeldBody, StretchAloneAndTorsionAloneHaveTheirDampingRatios) {
  const rod::PerDof ratio{0.3, 0.5, 0.7};
  for (const char* shape : {"linear", "constant", "bushing"}) {
    for (const bool torsion : {false, true}) {
      HeldBody held = held_by(shape, {2000.0, 500.0, 5.0}, ratio, box_off_centre());
      only(held, {!torsion, false, torsion});
      ASSERT_EQ(held.size(), 1);
      const double M = held.mass_matrix(0.0, held.zero_state().q)(0, 0), K = held.stiffness()[0];
      EXPECT_NEAR(held.damping()(0, 0) / (2.0 * std::sqrt(K * M)), torsion ? ratio.torsion : ratio.stretch, 1e-12)
          << shape;
    }
  }
}

TEST(HeldBody, WithModalDampingEveryModeHasTheRatio) {
  for (const char* shape : {"linear", "constant", "bushing"}) {
    for (double mass = 1e-6; mass < 2e6; mass *= 1e2) {
      for (const BodyInertia& body : grasps_of_long_box(mass)) {
        for (const rod::ForkDofs& dofs : families) {
          HeldBody held(rod::make_shape_model(test_support::shape_named(shape), 0.2), body, 9.81);
          held.set_springs_with_modal_damping({2000.0, 500.0, 5.0}, 0.6);
          only(held, dofs);
          const int n = held.size();
          const rod::StrainMatrix inverse_mass =
              held.mass_matrix(0.0, held.zero_state().q).llt().solve(rod::StrainMatrix::Identity(n, n));
          const double scale = std::sqrt(500.0 / mass);  // of the frequencies: velocities are taken over it
          Eigen::MatrixXd A = Eigen::MatrixXd::Zero(2 * n, 2 * n);
          A.topRightCorner(n, n).diagonal().setConstant(scale);
          A.bottomLeftCorner(n, n) = -(inverse_mass * held.stiffness().asDiagonal()) / scale;
          A.bottomRightCorner(n, n) = -(inverse_mass * held.damping());
          const Eigen::VectorXcd modes = A.eigenvalues();
          for (Eigen::Index m = 0; m < modes.size(); ++m) {
            EXPECT_NEAR(-modes[m].real() / std::abs(modes[m]), 0.6, 1e-8) << shape << " " << mass << " kg";
          }
        }
      }
    }
  }
}

TEST(HeldBody, ModalDampingIsExactOverDecadesOfStiffness) {
  // D M⁻¹ D = 4 ζ² K, each entry by the size of its own row and column; a coordinate without stiffness has no damping.
  std::mt19937 random(4);
  std::uniform_real_distribution<double> exponent(-6.0, 12.0);
  for (int trial = 0; trial < 200; ++trial) {
    rod::PerDof k{std::pow(10.0, exponent(random)), std::pow(10.0, exponent(random)), std::pow(10.0, exponent(random))};
    if (trial % 4 == 1) k.stretch = 0.0;
    if (trial % 4 == 2) k.bend = 0.0;
    if (trial % 4 == 3) k.torsion = 0.0;
    for (const BodyInertia& body : grasps_of_long_box(std::pow(10.0, -6.0 + trial % 13))) {
      HeldBody held(rod::make_shape_model(rod::ShapeKind::linear, 0.2), body, 9.81);
      held.set_springs_with_modal_damping(k, 3.0);
      const rod::StrainMatrix D = held.damping();
      const rod::StrainVector K = held.stiffness();
      const rod::StrainMatrix square = D * held.mass_matrix(0.0, held.zero_state().q).llt().solve(D);
      // To rounding times the spread of the frequencies.
      const double softest = (K.array() > 0.0).select(K, K.maxCoeff()).minCoeff();
      const double rounding = 1e-12 + 1e-13 * std::sqrt(K.maxCoeff() / softest);
      for (int i = 0; i < held.size(); ++i) {
        for (int j = 0; j < held.size(); ++j) {
          const double expected = i == j ? 36.0 * K[i] : 0.0;
          EXPECT_NEAR(square(i, j), expected, rounding * 36.0 * std::sqrt(K[i] * K[j])) << i << " " << j;
          if (K[i] == 0.0) {
            EXPECT_EQ(D(i, j), 0.0);
          }
        }
      }
    }
  }
}

/// Along the motion, the energy in the frame of the handle changes by the work of its accelerations, contact and
/// dampers: the 3/8 rule over a short time.
TEST(HeldBody, EnergyChangesByTheWorkThatIsTold) {
  constexpr double h = 2e-4;
  const motion::MotionSegment hand = moving_hand(0.5);
  std::mt19937 random(3);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  for (const std::string& shape : test_support::shape_names()) {
    for (const rod::ForkDofs& dofs : families) {
      for (const bool modal : {false, true}) {
        HeldBody held = held_by(shape, {200.0, 60.0, 1.0}, {0.3, 1.0, 2.0}, box_off_centre());
        if (modal) held.set_springs_with_modal_damping({200.0, 60.0, 1.0}, 0.7);
        only(held, dofs);
        held.set_load({Vector3d(0.5, -2.0, 1.0), Vector3d(0.1, 0.05, -0.2)});
        StrainState state = held.zero_state();
        for (Eigen::Index i = 0; i < state.q.size(); ++i) {
          state.q[i] = 0.05 * uniform(random);
          state.q_dot[i] = uniform(random);
        }
        const auto integrator = make_integrator(IntegratorKind::rk4);
        const math::Pack times{0.1, 0.1 + h, 0.1 + 2.0 * h, 0.1 + 3.0 * h};
        math::Pack q[rod::max_strain_coordinates], q_dot[rod::max_strain_coordinates];
        double expected[math::pack_size];
        for (int k = 0; k < math::pack_size; ++k) {
          if (k > 0) integrator->step(held, hand, times[k - 1], h, state);
          for (int i = 0; i < held.size(); ++i) {
            q[i][k] = state.q[i];
            q_dot[i][k] = state.q_dot[i];
          }
          const HandleState h_k = held.state_at(hand, times[k]);
          const motion::MotionState o = held.object(h_k, state);
          const Vector3d r = o.X.translation() - h_k.X_WH.translation(), p = held.body().mass * o.velocity.linear;
          const Matrix3d I_W = o.X.linear() * held.body().inertia_O * o.X.linear().transpose();
          expected[k] = held.elastic_energy(times[k], state) + held.kinetic_energy(o.velocity, o.X.linear()) +
                        held.body().mass * held.gravity() * r.z() - p.dot(h_k.v_WH_W) -
                        (I_W * o.velocity.angular + r.cross(p)).dot(h_k.X_WH.linear() * h_k.w_WH_H);
        }
        const EnergyBalance balance = held.energy_balance(held.state_at(hand, times), q, q_dot);
        const double scale = std::abs(expected[0]) + std::abs(balance.power[0]) * h;
        for (int k = 0; k < math::pack_size; ++k) EXPECT_NEAR(balance.energy[k], expected[k], 1e-12 * scale) << shape;
        const math::Pack& p = balance.power;
        EXPECT_NEAR(balance.energy[3] - balance.energy[0], 3.0 * h / 8.0 * (p[0] + 3.0 * (p[1] + p[2]) + p[3]),
                    1e-8 * scale)
            << shape << ' ' << modal;
      }
    }
  }
}

/// Results do not depend on earlier calls.
TEST(HeldBody, PoseJacobianAndMassMatrixDoNotDependOnWhatWasAskedBefore) {
  const motion::MotionSegment hand = moving_hand(0.5);
  for (const std::string& shape : test_support::shape_names()) {
    const HeldBody fresh = held_by(shape, {2000.0, 500.0, 5.0}, {0.3, 1.0, 2.0}, box_off_centre());
    HeldBody asked = fresh;
    const rod::StrainVector one = rod::StrainVector::Constant(fresh.size(), 0.1), rate = 3.0 * one;
    const HandleState handle = fresh.state_at(hand, 0.2);
    asked.object(handle, {2.0 * one, rate});
    asked.object_jacobian(0.2, one);
    const motion::MotionState again = asked.object(handle, {one, rate}, &rate),
                              now = HeldBody(fresh).object(handle, {one, rate}, &rate);
    EXPECT_EQ(again.X.matrix(), now.X.matrix());
    EXPECT_EQ(again.velocity.linear, now.velocity.linear);
    EXPECT_EQ(again.acceleration.linear, now.acceleration.linear);
    EXPECT_EQ(again.acceleration.angular, now.acceleration.angular);
    EXPECT_EQ(asked.object_jacobian(0.2, one), HeldBody(fresh).object_jacobian(0.2, one));
    EXPECT_EQ(asked.mass_matrix(0.2, 2.0 * one), HeldBody(fresh).mass_matrix(0.2, 2.0 * one));
  }
}

TEST(HeldBody, DampingIsWhatTheAccelerationTakesFromTheRates) {
  const motion::MotionSegment rest{RigidTransform::Identity()};
  for (const bool modal : {false, true}) {
    for (const std::string& shape : test_support::shape_names()) {
      for (const rod::ForkDofs& dofs : families) {
        HeldBody held = held_by(shape, {2000.0, 500.0, 5.0}, {0.3, 1.0, 2.0}, box_off_centre());
        if (modal) held.set_springs_with_modal_damping({2000.0, 500.0, 5.0}, 0.7);
        only(held, dofs);
        const HandleState hand = held.state_at(rest, 0.0);
        const rod::StrainVector q = held.zero_state().q;
        const rod::StrainMatrix M = held.mass_matrix(0.0, q), D = held.damping();
        for (int i = 0; i < held.size(); ++i) {
          const rod::StrainVector v =
              rod::StrainVector::Unit(held.size(), i);  // what is quadratic in it is the same for −v
          const rod::StrainVector force = 0.5 * M * (held.acceleration(hand, q, v) - held.acceleration(hand, q, -v));
          EXPECT_LT((force + D.col(i)).norm(), 1e-11 * D.norm()) << shape << " " << modal;
        }
      }
    }
  }
}

TEST(HeldBody, FamilyOffIsTheLimitOfAStiffOne) {
  const motion::MotionSegment hand = moving_hand(0.2);
  for (const char* name : {"exponential", "rosenbrock"}) {
    for (int family = 0; family < 3; ++family) {
      const auto end_pose = [&](double factor, bool on) {
        rod::PerDof k{2000.0, 500.0, 5.0};
        (family == 0 ? k.stretch : family == 1 ? k.bend : k.torsion) *= factor;
        HeldBody held = held_by("linear", k, {1.0, 1.0, 1.0}, box_off_centre());
        if (!on) only(held, {family != 0, family != 1, family != 2});
        StrainState s = held.zero_state();
        const auto integrator = test_support::make_integrator(name);
        for (int i = 0; i < 200; ++i) integrator->step(held, hand, 0.001 * i, 0.001, s);
        return held.object(held.state_at(hand, 0.2), s).X;
      };
      const RigidTransform rigid = end_pose(1.0, false);
      double last = 1.0;
      for (double factor : {1e3, 1e5, 1e7, 1e9, 1e12}) {
        const double distance = (end_pose(factor, true).matrix() - rigid.matrix()).norm();
        // 2e-6: the integrator's own error at this step
        EXPECT_LT(distance, std::max(0.1 * last, 2e-6)) << name << " family " << family << " × " << factor;
        last = distance;
      }
    }
  }
}

TEST(HeldBody, WithoutStiffnessTheObjectIsFreeInThatFamily) {
  for (const char* name : {"exponential", "rosenbrock", "rk4"}) {
    for (double zeta : {0.0, 1.0}) {
      BodyInertia body;
      body.mass = 0.8;
      HeldBody held = held_by("linear", {0.0, 500.0, 5.0}, {zeta, zeta, zeta}, body);
      StrainState s = held.zero_state();
      const motion::MotionSegment hand(hanging());
      const auto integrator = test_support::make_integrator(name);
      for (int i = 0; i < 20; ++i) integrator->step(held, hand, 0.01 * i, 0.01, s);
      EXPECT_NEAR(held.shape().extension(s.q), 0.5 * 9.81 * 0.04, 1e-9) << name << " " << zeta;
    }
  }
}

TEST(HeldBody, SwitchingOffWhileStrainedKeepsPoseAndTwistAndEndsAtZero) {
  HeldBody held = held_by("linear", {2000.0, 500.0, 5.0}, {1.0, 1.0, 1.0}, box_off_centre());
  const motion::MotionSegment hand = moving_hand(2.0);
  StrainState s = held.zero_state();
  const auto integrator = dynamics::make_integrator(dynamics::IntegratorKind::exponential);
  double t = 0.0;
  for (; t < 0.2; t += 0.01) integrator->step(held, hand, t, 0.01, s);
  const motion::MotionState before = held.object(held.state_at(hand, t), s);
  const double torsion = held.shape().torsion_angle(held.full_state(t, s).q);
  ASSERT_GT(std::abs(torsion), 1e-4);
  s = held.set_dofs({true, true, false}, t, 0.01, held.full_state(t, s));
  EXPECT_EQ(held.size(), 5);
  const motion::MotionState after = held.object(held.state_at(hand, t), s);
  EXPECT_LT((after.X.matrix() - before.X.matrix()).norm(), 1e-14);
  EXPECT_LT((after.velocity.linear - before.velocity.linear).norm(), 1e-14);
  EXPECT_LT((after.velocity.angular - before.velocity.angular).norm(), 1e-13);
  for (; t < 1.0; t += 0.01) {
    integrator->step(held, hand, t, 0.01, s);
    held.drop_finished_returns(t + 0.01);
  }
  EXPECT_FALSE(held.returning());
  EXPECT_EQ(held.shape().torsion_angle(held.full_state(t, s).q), 0.0);
}

TEST(Exponential, StaysBoundedAtEveryStiffnessAndStep) {
  std::mt19937 random(11);
  std::uniform_real_distribution<double> exponent(-1.0, 1.0);
  for (int trial = 0; trial < 200; ++trial) {
    const double k = std::pow(10.0, 5.0 + 5.0 * exponent(random));
    const double m = std::pow(10.0, 3.0 * exponent(random));
    const double h = std::pow(10.0, -2.0 + 0.7 * exponent(random));
    const double zeta = trial % 3 == 0 ? 0.0 : trial % 3 == 1 ? 1.0 : 5.0;
    // The calibrated range and stiffer: a fork that can carry its object.
    if (m * 9.81 > 0.5 * 0.2 * k) continue;
    BodyInertia body = box_off_centre();
    body.inertia_O *= m / body.mass;
    body.mass = m;
    HeldBody held = held_by("linear", {4.0 * k, k, 0.01 * k}, {zeta, zeta, zeta}, body);
    StrainState s = held.zero_state();
    const motion::MotionSegment hand = moving_hand(20.0 * h);
    const auto integrator = dynamics::make_integrator(dynamics::IntegratorKind::exponential);
    for (int i = 0; i < 20; ++i) integrator->step(held, hand, h * i, h, s);
    EXPECT_TRUE(s.q.allFinite() && s.q_dot.allFinite());
    EXPECT_TRUE(held.shape().admissible(s.q)) << "k " << k << " m " << m << " h " << h << " ζ " << zeta;
  }
}

}  // namespace
}  // namespace spring_workbench::dynamics::held_body_test
