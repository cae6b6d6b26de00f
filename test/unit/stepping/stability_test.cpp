#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

#include "spring_workbench/stepping/step_control.h"
#include "support/held_cases.h"
#include "support/named.h"

namespace spring_workbench::stepping::stability_test {
namespace {

using namespace dynamics;

// The cells of the stability map: stiffness × mass × step × damping × families × hand. Samples of the hand come with
// the steps, at most 50 a second.

constexpr double stiffness_factors[] = {1e-6, 1e-3, 1.0, 1e3, 1e6, 1e9, 1e12};
constexpr double masses[] = {1e-6, 1e-3, 1.0, 1e3, 1e6};
constexpr double steps[] = {1.0 / 20, 1.0 / 100, 1.0 / 1000};
constexpr double damping_ratios[] = {0.0, 0.1, 1.0, 10.0};
enum class Hand { lissajous, jump, flip, dropout, noise };
constexpr Hand hands[] = {Hand::lissajous, Hand::jump, Hand::flip, Hand::dropout, Hand::noise};

RigidTransform pose(Hand hand, double t, std::mt19937& random) {
  const Vector3d on_sines(0.15 * std::sin(6.3 * t), 0.15 * std::sin(8.2 * t + 1.0), 0.15 * std::sin(10.7 * t + 2.0));
  std::normal_distribution<double> normal;
  switch (hand) {
    case Hand::lissajous:
      return make_transform(
          on_sines, Quaterniond(math::exp_so3(Vector3d(0.6 * std::sin(5.0 * t), 0.6 * std::sin(7.0 * t), 0.0))));
    case Hand::jump:
      return make_transform(Vector3d(t > 0.2 ? 1.0 : 0.0, 0.0, 0.0), Quaterniond::Identity());
    case Hand::flip:
      return make_transform(Vector3d::Zero(), Quaterniond(math::exp_so3(Vector3d(t > 0.2 ? M_PI : 0.0, 0.0, 0.0))));
    case Hand::dropout:
      return make_transform(t < 0.2 ? on_sines : Vector3d(0.1, 0.2, 0.3), Quaterniond::Identity());
    case Hand::noise: {
      const Vector3d p(normal(random), normal(random), normal(random)),
          w(normal(random), normal(random), normal(random));
      return make_transform(1e-3 * p, Quaterniond(math::exp_so3(M_PI / 180.0 * w)));
    }
  }
  return RigidTransform::Identity();
}

struct Cell {
  double factor, mass, step, zeta;
  int families;  ///< bits: stretch, bend, torsion
  Hand hand;
};

HeldBody body_of(const Cell& cell, const std::string& shape) {
  BodyInertia body;
  body.mass = cell.mass;
  body.inertia_O = cell.mass / 12.0 * Vector3d(0.0125, 0.0425, 0.05).asDiagonal().toDenseMatrix();
  body.X_OE.translation() << 0.08, 0.0, 0.0;
  HeldBody held(rod::make_shape_model(test_support::shape_named(shape), 0.2), body, 9.81);
  held.set_springs({5000.0 * cell.factor, 2000.0 * cell.factor, 20.0 * cell.factor}, {cell.zeta, cell.zeta, cell.zeta});
  const rod::StrainVector zero = rod::StrainVector::Zero(held.shape().size());
  held.set_dofs({(cell.families & 1) != 0, (cell.families & 2) != 0, (cell.families & 4) != 0}, 0.0, 0.05,
                {zero, zero});
  return held;
}

double energy(const HeldBody& held, const motion::MotionSegment& hand, double t, const StrainState& s) {
  const HandleState f = held.state_at(hand, t);
  const motion::MotionState o = held.object(f, s);
  const double height = o.X.translation().z() - held.object(f, held.zero_state()).X.translation().z();
  return held.elastic_energy(t, s) + held.kinetic_energy(o.velocity, o.X.linear()) + held.body().mass * 9.81 * height;
}

/// Runs half a second with the hand moving, then half a second at rest. Returns an empty string if there is no problem.
std::string what_is_wrong(const Cell& cell, const std::string& shape, const std::string& integrator) {
  const HeldBody held = body_of(cell, shape);
  const StepControl control(test_support::make_integrator(integrator));
  StepControl::Memory memory;
  std::mt19937 random(3);
  motion::PoseTrack track;
  const double interval = std::max(cell.step, 0.02);
  for (double t = 0.0; t < 0.5 + 0.5 * interval; t += interval) {
    if (cell.hand == Hand::dropout && t > 0.2 && t < 0.45) continue;
    track.push({t, pose(cell.hand, t, random)});
  }
  StrainState state = held.zero_state();
  double lowest = 0.0, scale = 0.0, estimated = 0.0;
  const double rest_from = track.end();
  for (double t = 0.0; t < 0.8;) {
    const motion::MotionSegment segment = track.segment(t + 1e-9);
    const double h = std::min(cell.step, t < rest_from - 1e-9 ? segment.end() - t : 1.0);
    const ControlledStep step = control.advance(held, segment, t, h, state, memory);
    if (!step.accepted) return "refused";
    t += h;
    if (!state.q.allFinite() || !state.q_dot.allFinite()) return "not finite";
    const motion::MotionState o = held.object(held.state_at(segment, t), state);
    if (o.X.translation().norm() > 1e4) return "not bounded: " + std::to_string(o.X.translation().norm());
    if (t < rest_from + 1e-9) continue;
    const motion::MotionSegment rest = track.segment(rest_from + 1.0);
    const double e = energy(held, rest, t, state);
    if (scale == 0.0) {
      lowest = e;
      const double kinetic = held.kinetic_energy(o.velocity, o.X.linear());
      scale = kinetic + std::abs(e - kinetic);
    }
    estimated += step.energy_error;
    if (e - lowest > std::min(estimated, 0.01 * scale) + 1e-9 * scale + 1e-15 * cell.mass * 9.81)
      return "energy grows by " + std::to_string(e - lowest) + " J, " + std::to_string(estimated) + " estimated, of " +
             std::to_string(scale);  // last: of the height
    if (e < lowest) {
      lowest = e;
      estimated = 0.0;
    }
  }
  return "";
}

class StableIntegrator : public testing::TestWithParam<std::string> {};

TEST_P(StableIntegrator, AnObjectThatFallsOntoItsHandleStopsThereAndTurnsOn) {
  // No spring in stretch and torsion: it falls freely down the fork, turning.
  for (const double step : {0.05, 0.02, 0.003}) {
    Cell cell{0.0, 2.0, step, 0.0, 1 + 4, Hand::jump};
    HeldBody held = body_of(cell, "linear");
    const StepControl control(test_support::make_integrator(GetParam()));
    StepControl::Memory memory;
    const motion::MotionSegment rest(RigidTransform::Identity());
    StrainState state = held.zero_state();
    state.q_dot[0] = 5.0;  // of the twist, over the length
    double fallen = 0.0, t = 0.0;
    for (; t < 0.6; t += step) {
      ASSERT_TRUE(control.advance(held, rest, t, step, state, memory).accepted) << step << " " << t;
      ASSERT_TRUE(held.shape().admissible(held.full_state(t, state).q));
      if (state.q_dot[1] < 0.0) fallen = state.q[1];
    }
    EXPECT_LT(fallen, -0.5);
    EXPECT_NEAR(state.q[1], -0.98, 1e-6);
    EXPECT_NEAR(state.q_dot[1], 0.0, 1e-12);
    EXPECT_NEAR(state.q_dot[0], 5.0, 1e-6);
    EXPECT_NEAR(state.q[0], 5.0 * t, 1e-6);
  }
}

TEST_P(StableIntegrator, AnObjectThatIsAtTwoStopsRestsThere) {
  // Compressed by its weight, and wound up by its spin.
  for (const double step : {0.05, 0.02, 0.003}) {
    const HeldBody held = body_of({0.0, 2.0, step, 0.0, 1 + 4, Hand::jump}, "linear");
    const StepControl control(test_support::make_integrator(GetParam()));
    StepControl::Memory memory;
    const motion::MotionSegment rest(RigidTransform::Identity());
    StrainState state = held.zero_state();
    state.q_dot[0] = 2000.0;
    for (double t = 0.0; t < 1.0; t += step) {
      ASSERT_TRUE(control.advance(held, rest, t, step, state, memory).accepted) << step << " " << t;
      ASSERT_TRUE(held.shape().admissible(held.full_state(t, state).q));
    }
    EXPECT_NEAR(state.q[1], -0.98, 1e-6) << step;
    EXPECT_NEAR(state.q_dot.norm(), 0.0, 1e-9) << step;
  }
}

TEST(Stop, NeitherGainsNorLosesEnergyWhereTheHandsAccelerationRises) {
  // Compressed by its weight it turns about the fork's axis, sliding along the stop, while the hand goes sideways.
  for (const double jerk : {400.0, -400.0}) {  // [m/s³]
    constexpr double h = 1e-3, duration = 0.1;
    const HeldBody held = body_of({0.0, 2.0, h, 0.0, 1 + 4, Hand::jump}, "linear");
    const StepControl control(make_integrator(IntegratorKind::exponential));
    StepControl::Memory memory;
    RigidTransform there = RigidTransform::Identity();
    there.translation().y() = jerk * std::pow(duration, 3) / 6.0;
    const Vector3d still = Vector3d::Zero(), fast(0.0, jerk * duration * duration / 2.0, 0.0);
    const motion::MotionSegment hand({0.0, RigidTransform::Identity()}, still, still, {duration, there}, fast, still);
    StrainState state = held.zero_state();
    state.q[1] = -0.98 + 1e-9;
    state.q_dot[0] = 50.0;  // of the twist, over the length
    const auto seen_from_hand = [&] { return held.object(HandleState(), state); };
    const auto energy = [&] {
      const motion::MotionState o = seen_from_hand();
      return held.kinetic_energy(o.velocity, o.X.linear()) + 2.0 * 9.81 * o.X.translation().z();
    };
    const double begin = energy();
    double work = 0.0, of_one_step = 0.0;  // of the hand's acceleration; of its change over a step
    int stops = 0;
    for (int i = 0; i < 100; ++i) {
      const double v = seen_from_hand().velocity.linear.y();
      stops += control.advance(held, hand, i * h, h, state, memory).stops;
      const double v_then = seen_from_hand().velocity.linear.y();
      work -= 0.5 * h * 2.0 * jerk * h * (i * v + (i + 1) * v_then);
      of_one_step += 0.5 * h * std::abs(2.0 * jerk * h * v);
    }
    EXPECT_GT(stops, 90);
    EXPECT_NEAR(energy() - begin, work, 0.05 * of_one_step) << jerk;
  }
}

TEST(ImplicitEuler, SolvesWholeStepsOfAVeryStiffFork) {
  // At rest after a leap the first change of Newton's method is of the size of rounding errors.
  for (const Hand hand : {Hand::jump, Hand::noise}) {
    for (const double mass : {1e-6, 1.0}) {
      const HeldBody held = body_of({1e12, mass, 1e-3, 0.0, 7, hand}, "linear");
      const StepControl control(make_integrator(IntegratorKind::implicit_euler));
      StepControl::Memory memory;
      std::mt19937 random(3);
      motion::PoseTrack track;
      for (double t = 0.0; t < 1.05; t += 0.02) track.push({t, pose(hand, t, random)});
      StrainState state = held.zero_state();
      int taken = 0;
      for (int i = 0; i < 1000; ++i) {
        taken += control.advance(held, track.segment(i * 1e-3 + 1e-9), i * 1e-3, 1e-3, state, memory).steps;
      }
      EXPECT_EQ(taken, 1000) << mass;
    }
  }
}

TEST(UndampedFork, GainsNoEnergyWhileTheHandTremblesByANanometre) {
  // After a leap of 1 m and after a half turn. What the hand's tremor can do is far below what is asked.
  for (const Hand hand : {Hand::jump, Hand::flip}) {
    const Cell cell{0.4, 1.0, 0.02, 0.0, 7, hand};
    const HeldBody held = body_of(cell, "linear");
    const StepControl control(make_integrator(IntegratorKind::exponential));
    StepControl::Memory memory;
    std::mt19937 random(5);
    std::normal_distribution<double> normal;
    motion::PoseTrack track;
    for (double t = 0.0; t < 20.1; t += 0.02) {
      RigidTransform X = pose(hand, t, random);
      X.translation() += 1e-9 * Vector3d(normal(random), normal(random), normal(random));
      track.push({t, X});
    }
    StrainState state = held.zero_state();
    double largest = 0.0, highest_later = 0.0, estimated = 0.0;
    int fallback = 0, taken = 0;
    for (double t = 0.0; t < 20.0;) {
      const motion::MotionSegment segment = track.segment(t + 1e-9);
      const double h = segment.end() - t;
      const ControlledStep step = control.advance(held, segment, t, h, state, memory);
      ASSERT_TRUE(step.accepted) << t;
      t += h;
      estimated += step.energy_error;
      fallback += step.fallback;
      taken += step.steps;
      const double e = energy(held, segment, t, state);
      if (t < 0.3) {
        largest = std::max(largest, e);
      } else {
        highest_later = std::max(highest_later, e);
      }
    }
    EXPECT_LT(highest_later, largest + estimated + 1e-6 * largest) << static_cast<int>(hand);
    EXPECT_LT(estimated, 0.01 * largest) << static_cast<int>(hand);
    EXPECT_LT(fallback, 0.02 * taken) << static_cast<int>(hand);
  }
}

TEST_P(StableIntegrator, EveryCellStaysBoundedAndNoEnergyGrowsWithTheHandAtRest) {
  std::mt19937 random(17);
  const auto any = [&](const auto& values) {
    return values[std::uniform_int_distribution<std::size_t>(0, std::size(values) - 1)(random)];
  };
  int wrong = 0;
  const int trials = 28;
  for (int trial = 0; trial < trials; ++trial) {
    const Cell cell{any(stiffness_factors), any(masses), any(steps), any(damping_ratios), 1 + trial % 7, any(hands)};
    const std::string shape =
        test_support::shape_names()[static_cast<std::size_t>(trial) % test_support::shape_names().size()];
    const std::string complaint = what_is_wrong(cell, shape, GetParam());
    if (complaint.empty()) continue;
    ++wrong;
    ADD_FAILURE() << shape << ": stiffness × " << cell.factor << ", " << cell.mass << " kg, step " << cell.step
                  << " s, ζ " << cell.zeta << ", families " << cell.families << ", hand " << static_cast<int>(cell.hand)
                  << ": " << complaint;
  }
  EXPECT_EQ(wrong, 0) << "of " << trials;
}

INSTANTIATE_TEST_SUITE_P(Integrators, StableIntegrator, testing::Values("exponential", "rosenbrock", "implicit_euler"),
                         [](const auto& instance) { return instance.param; });

}  // namespace
}  // namespace spring_workbench::stepping::stability_test
