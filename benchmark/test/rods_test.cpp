// Rod cases, their references, the elastica and the stability map.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <fstream>
#include <map>
#include <random>
#include <set>
#include <sstream>
#include <string>
#include <tuple>

#include "benchmark/elastica.h"
#include "benchmark/energy_watch.h"
#include "benchmark/full_map.h"
#include "benchmark/ode_solver.h"
#include "benchmark/rod_reference.h"
#include "benchmark/rod_table.h"
#include "benchmark/simulated_rod.h"
#include "benchmark/stability_map.h"
#include "case_called.h"
#include "spring_workbench/dynamics/integrator.h"
#include "spring_workbench/validation/input_error.h"
#include "spring_workbench/validation/names.h"
#include "support/paths.h"
#include "test/support/temporary_folder.h"

namespace spring_workbench::benchmark::rods_test {
namespace {

TEST(RodCases, HandsAreTheSameFromTheSameSeedAndOthersFromAnother) {
  const auto a = synthetic_hand(3, 1.0), b = synthetic_hand(3, 1.0), c = synthetic_hand(4, 1.0);
  ASSERT_EQ(a.size(), 51U);
  double differs = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    EXPECT_EQ(a[i].X.matrix(), b[i].X.matrix());
    differs = std::max(differs, (a[i].X.translation() - c[i].X.translation()).norm());
  }
  EXPECT_GT(differs, 0.01);
}

TEST(RodCases, ReferenceOfAStretchingForkOnAHandAtRestIsTheExactOscillator) {
  // The handle points up and rests: a single spring under the weight, starting from zero extension.
  for (const double zeta : {0.0, 0.1, 1.0, 3.0}) {
    RodCase one = case_called("stretch_only", 1.0);
    one.fork.damping_ratio = {zeta, zeta, zeta};
    for (motion::PoseSample& sample : one.hand) sample.X = RigidTransform::Identity();
    const double k = one.fork.stiffness.stretch, m = one.mass, omega = std::sqrt(k / m), sag = m * 9.81 / k;
    const auto poses = fine_poses(one, "linear", kFineTolerance);
    const auto times = output_times(one);
    ASSERT_EQ(poses.size(), times.size());
    for (std::size_t i = 0; i < times.size(); ++i) {
      const double t = times[i], sigma = zeta * omega;
      const double root = std::sqrt(std::abs(omega * omega - sigma * sigma));
      const double c = zeta < 1.0 ? std::cos(root * t) : std::cosh(root * t);
      const double s = zeta == 1.0 ? t : (zeta < 1.0 ? std::sin(root * t) : std::sinh(root * t)) / root;
      const double extension = -sag + sag * std::exp(-sigma * t) * (c + sigma * s);
      EXPECT_NEAR(poses[i].translation().z() - (one.fork.length - one.p_OE.z()), extension, 1e-10) << zeta << ' ' << t;
    }
  }
}

TEST(RodCases, WhatTheSamplesLeaveIsTheDistanceFromTheExactMotionOnTheHandItself) {
  // A single spring on a hand that trembles along it with A sin(ωₕ t), in closed form.
  constexpr double kTremor = 1e-3, kRate = 2.0 * 3.14159265358979324 * 10.0;
  RodCase one = case_called("stretch_only", 1.0);
  one.fork.damping_ratio = {0.1, 0.1, 0.1};
  for (auto* hand : {&one.hand, &one.fine_hand}) {
    for (motion::PoseSample& sample : *hand)
      sample.X = make_transform({0.0, 0.0, kTremor * std::sin(kRate * sample.t)}, Quaterniond::Identity());
  }
  using Complex = std::complex<double>;
  const double k = one.fork.stiffness.stretch, m = one.mass, omega = std::sqrt(k / m), sigma = 0.1 * omega;
  const double root = std::sqrt(omega * omega - sigma * sigma), sag = m * 9.81 / k;
  const Complex driven = kTremor * kRate * kRate / Complex(omega * omega - kRate * kRate, 2.0 * sigma * kRate);
  // The free oscillation, with which the extension and its rate begin at zero.
  const double a = sag - driven.imag(), b = (sigma * a - kRate * driven.real()) / root;
  const RodCase halfway = with_halfway_outputs(one);
  const auto times = output_times(halfway);
  const RodReference reference = rod_reference(one, "linear");
  double left = 0.0;
  for (std::size_t i = 0; i < times.size(); ++i) {
    const double t = times[i], extension = -sag + (driven * std::exp(Complex(0.0, kRate * t))).imag() +
                                           std::exp(-sigma * t) * (a * std::cos(root * t) + b * std::sin(root * t));
    const double z = kTremor * std::sin(kRate * t) + one.fork.length - one.p_OE.z() + extension;
    left = std::max(left, std::abs(reference.halfway[i].translation().z() - z));
  }
  EXPECT_GT(left, 1e-6);
  EXPECT_NEAR(reference.hand_error, left, 0.02 * left);
  one.fine_hand.clear();
  EXPECT_EQ(rod_reference(one, "linear").hand_error, 0.0);
}

TEST(RodCases, ReferenceAgreesWithRungeKuttaAtATinyStepInEveryShape) {
  const RodCase one = case_called("heavy_large_bend", 0.3);
  for (const std::string& shape : one.shapes) {
    const RodReference reference = rod_reference(one, shape);
    EXPECT_LT(reference.uncertainty, 1e-8) << shape;
    EXPECT_GT(reference.largest_deflection, 1e-3) << shape;
    const PoseDistance distance = largest_distance(run_simulated(one, shape, "rk4", 5e-5).X_WO, reference.X_WO);
    EXPECT_LT(distance.position, 1e-8) << shape;
    EXPECT_LT(distance.angle, 1e-7) << shape;
  }
}

/// SUNDIALS CVODE at 1e-12 on the equation of motion, restarted at every sample.
std::vector<RigidTransform> cvode_poses(const RodCase& one, const std::string& shape) {
  const dynamics::HeldBody body = held_body(one, shape);
  const int n = body.size();
  const auto state = [n](const double* y) {
    return dynamics::StrainState{Eigen::Map<const Eigen::VectorXd>(y, n), Eigen::Map<const Eigen::VectorXd>(y + n, n)};
  };
  motion::PoseTrack track = hand_track(one);
  const motion::MotionSegment* segment = &track.segment(0.0);
  const auto cvode = make_cvode(CvodeFormula::bdf, 2 * n, [&](double t, const double* y, double* rate) {
    Eigen::Map<Eigen::VectorXd>(rate, n) = state(y).q_dot;
    Eigen::Map<Eigen::VectorXd>(rate + n, n) =
        body.acceleration(body.state_at(*segment, t), state(y).q, state(y).q_dot);
    return true;
  });
  std::vector<double> y(static_cast<std::size_t>(2 * n), 0.0), scale = y;
  for (int i = 0; i < 2 * n; ++i) {
    const double strain = std::min(1.0, one.mass * 9.81 * one.fork.length / body.stiffness()[i % n]);
    scale[static_cast<std::size_t>(i)] = (i < n ? 1.0 : 10.0) * strain;
  }
  cvode->begin(0.0, y, 1e-12, scale);
  std::vector<RigidTransform> poses{body.object(body.state_at(*segment, 0.0), state(y.data())).X};
  for (const double end : output_times(one)) {
    if (end == 0.0) continue;
    segment = &track.segment(end - 0.01);
    const double* reached = cvode->advance(end, end);
    poses.push_back(body.object(body.state_at(*segment, end), state(reached)).X);
  }
  return poses;
}

TEST(RodCases, ReferenceAgreesWithCvode) {
  const auto expect_near = [](const RodCase& one, const std::string& shape) {
    const RodReference reference = rod_reference(one, shape);
    EXPECT_LT(reference.uncertainty, 1e-12) << one.name << ' ' << shape;
    const PoseDistance distance = largest_distance(cvode_poses(one, shape), reference.X_WO);
    EXPECT_LT(distance.position, 1e-10) << one.name << ' ' << shape;
    EXPECT_LT(distance.angle, 1e-9) << one.name << ' ' << shape;
  };
  for (const std::string name : {"soft_6dof", "underdamped", "stiff_6dof", "heavy_large_bend"}) {
    const RodCase one = case_called(name, 0.3);
    for (const std::string& shape : one.shapes) expect_near(one, shape);
  }
  for (const std::string name : {"soft_light", "stiff_heavy"}) expect_near(case_called(name, 0.2), "linear");
  for (const double factor : {1.0, 1e4}) {
    RodCase bushing = rod_case(with_sampled_hand(six_dof_scene(factor)));
    bushing.duration = 0.2;
    expect_near(bushing, "bushing");
  }
}

TEST(RodCases, AStiffLightBushingOnASampledHandHasAReference) {
  // A gram on a fork of 2e9 N/m swings in 4 µs, and the rates jump at every sample.
  RodCase one = rod_case(with_sampled_hand(six_dof_scene(1e6, 1.0, 1e-3)));
  one.duration = 0.5;
  const RodReference reference = rod_reference(one, "bushing");
  EXPECT_LT(reference.uncertainty, 1e-16);
  EXPECT_LT(reference.largest_deflection, 1e-9);
}

/// The first half second of `one` against the trajectory that comes with it.
void expect_to_meet_its_trajectory(RodCase one) {
  one.duration = 0.5;
  const PoseDistance distance =
      largest_distance(fine_poses(one, one.shapes[0], kFineTolerance), rod_reference(one, one.shapes[0]).X_WO);
  EXPECT_LT(distance.position, 1e-8) << one.name;
  EXPECT_LT(distance.angle, 1e-7) << one.name;
}

TEST(RodCases, ReferenceMeetsTheTrajectoriesOfAnotherSolver) {
  for (const std::string name : {"swing_soft", "swing_bend_only", "reach_constant_shape"}) {
    RodCase one = case_called("soft_6dof", 0.5);
    if (name == "swing_bend_only") one.fork.dofs = {false, true, false};
    one.name = name;
    one.shapes = {name == "reach_constant_shape" ? "constant" : "linear"};
    one.hand = read_motion(test_support::checkout("test/data/reference/motion_") + name.substr(0, 5) + ".tum");
    one.recorded = test_support::checkout("test/data/reference/") + name + ".csv";
    expect_to_meet_its_trajectory(one);
  }
}

TEST(RodCases, ReferenceMeetsTheRecordedTrajectoriesOfAnotherSolver) {
  const std::string folder = test_support::extra_data("reference");
  if (folder.empty()) GTEST_SKIP() << "SPRING_WORKBENCH_TEST_DATA is not given";
  const std::vector<RodCase> recorded = recorded_cases(folder);
  EXPECT_EQ(recorded.size(), 9u);
  for (const RodCase& one : recorded) expect_to_meet_its_trajectory(one);
}

TEST(RodTable, WhatIsComparedIsTheLargestErrorOfPositionAngleAndHalfWay) {
  RodTablePlan plan = rod_table_plan(true, "");
  RodCase one = case_called("underdamped", 0.5);
  one.shapes = {"linear"};
  plan.cases = {one};
  plan.steps_per_output = {1, 2};
  plan.repetition = {};
  plan.tolerance_time_limit = 60.0;
  std::ostringstream log;
  Progress progress(log, false, unit_count(plan));
  Units units(progress, Shard{});
  std::set<std::string> methods;
  for (const ErrorRow& row : rod_table(plan, {}, units)) {
    methods.insert(row.method);
    if (!row.finite) continue;
    EXPECT_EQ(row.error, std::max({row.position_error, row.error_between, row.angle_error * farthest_point(one)}));
    EXPECT_GE(row.angle_error, 0.0);
    // With two steps in 20 ms one ends halfway, so the other run is the same with more outputs.
    if (row.step == 0.01) {
      EXPECT_GE(row.error_between, row.position_error * (1.0 - 1e-6)) << row.method;
    }
  }
  EXPECT_EQ(methods.size(), validation::names<dynamics::IntegratorKind>().size() + 13U);
}

TEST(RodTable, TheFarthestPointIsACornerOfTheBox) {
  RodCase one;
  one.mass = 2.0;
  const Vector3d size(0.3, 0.2, 0.1), squares = size.cwiseAbs2();
  one.inertia = one.mass / 12.0 * (Vector3d::Constant(squares.sum()) - squares);
  EXPECT_NEAR(farthest_point(one), 0.5 * size.norm(), 1e-12);
}

TEST(Elastica, ExactSolutionSatisfiesItsDifferentialEquation) {
  // Shooting: θ'' = −α cos θ from θ = 0 with the slope that energy gives, θ'² = 2 α (sin ψ − sin θ), by RK4.
  for (const double alpha : {0.1, 1.0, 5.0, 10.0}) {
    const TipDeflection tip = exact_elastica(alpha);
    double theta = 0.0, rate = std::sqrt(2.0 * alpha * std::sin(tip.slope)), x = 0.0, z = 0.0;
    constexpr int count = 4000;
    const double h = 1.0 / count;
    for (int i = 0; i < count; ++i) {
      const auto bend = [&](double angle) { return -alpha * std::cos(angle); };
      const double k1 = rate, l1 = bend(theta), k2 = rate + 0.5 * h * l1, l2 = bend(theta + 0.5 * h * k1);
      const double k3 = rate + 0.5 * h * l2, l3 = bend(theta + 0.5 * h * k2), k4 = rate + h * l3,
                   l4 = bend(theta + h * k3);
      const double middle = theta + 0.5 * h * k1 + 0.125 * h * h * l1,
                   next = theta + h / 6.0 * (k1 + 2.0 * (k2 + k3) + k4);
      x += h / 6.0 * (std::sin(theta) + 4.0 * std::sin(middle) + std::sin(next));
      z += h / 6.0 * (std::cos(theta) + 4.0 * std::cos(middle) + std::cos(next));
      rate += h / 6.0 * (l1 + 2.0 * (l2 + l3) + l4);
      theta = next;
    }
    EXPECT_NEAR(theta, tip.slope, 1e-9) << alpha;
    EXPECT_NEAR(rate, 0.0, 1e-8) << alpha;
    EXPECT_NEAR(x, tip.deflection, 1e-8) << alpha;
    EXPECT_NEAR(1.0 - z, tip.shortening, 1e-8) << alpha;
  }
}

TEST(Elastica, ExactSolutionIsTheReferenceTable) {
  const std::string folder = test_support::extra_data("reference");
  if (folder.empty()) GTEST_SKIP() << "SPRING_WORKBENCH_TEST_DATA is not given";
  const double difference = elastica_check(folder);
  EXPECT_GE(difference, 0.0) << "no elastica.csv";
  EXPECT_LT(difference, 1e-9);
}

TEST(Elastica, RodsComeToTheExactSolutionForSmallLoadsAndMoreTermsAreNearer) {
  for (const std::string& shape : validation::names<rod::ShapeKind>()) {
    EXPECT_NEAR(shape_deflection(shape, 1e-3).deflection, 1e-3 / 3.0, 1e-8) << shape;
  }
  const auto error = [](const std::string& shape) {
    return std::abs(shape_deflection(shape, 2.0).deflection - exact_elastica(2.0).deflection);
  };
  EXPECT_LT(error("linear"), 0.1 * error("constant"));
}

TEST(StabilityMap, SamplesOfTheHandsComeInOrderAndRestAsPlanned) {
  const StabilityPlan plan = stability_plan(true);
  for (std::size_t i = 0; i < plan.hands.size() * plan.tails.size(); ++i) {
    const MapHand hand = plan.hands[i % plan.hands.size()];
    const MapTail tail = plan.tails[i / plan.hands.size()];
    for (const double step : {0.05, 0.001}) {
      const MapHandMotion motion = map_hand_motion(hand, tail, 0.3, std::max(step, 0.02), step);
      motion::PoseTrack track;
      for (const motion::PoseSample& sample : motion.samples) EXPECT_TRUE(track.push(sample)) << name_of(hand);
      double last = 0.0;
      for (const auto& [begin, end, rests] : motion.watched) {
        EXPECT_LE(last, begin) << name_of(hand);
        last = end;
        const RigidTransform X = track.segment(begin).at(begin).X;
        for (double t = begin; t < end; t += 0.1 * (end - begin)) {
          const motion::MotionState state = track.segment(t).at(t);
          EXPECT_LT((state.X.linear() - X.linear()).norm(), 1e-12) << name_of(hand) << ' ' << t;
          EXPECT_LT(state.velocity.angular.norm(), 1e-12) << name_of(hand) << ' ' << t;
          if (!rests) continue;
          EXPECT_LT((state.X.matrix() - X.matrix()).norm(), 1e-12) << name_of(hand) << ' ' << t;
          EXPECT_LT(state.velocity.linear.norm(), 1e-12) << name_of(hand) << ' ' << t;
        }
      }
      if (tail != MapTail::lissajous) {
        EXPECT_DOUBLE_EQ(last, motion.samples.back().t) << name_of(hand);
      }
    }
  }
}

StabilityCell cell_with(double omega_step, MapTail tail) {
  StabilityCell cell;
  cell.step = 0.001;                 // a jump of 1 m within 20 ms does not fully compress such a stiff spring
  cell.dofs = {true, false, false};  // one spring: ω² = k / m
  cell.damping_ratio = 1.0;
  cell.stiffness_factor = std::pow(omega_step / cell.step, 2) * cell.mass / 2000.0;
  cell.tail = tail;
  return cell;
}

/// An EnergyWatch on the exact motion of 2 kg on one undamped spring along z, whose end the handle moves. `error` is
/// added to the energy at each call, and reported as an estimate if `is_told`.
EnergyWatch watched(double omega, double h, double tremor, double error, bool is_told) {
  constexpr double mass = 2.0, gravity = 9.81, interval = 0.02;
  std::mt19937 random(5);
  std::uniform_real_distribution<double> any(-tremor, tremor);
  motion::PoseTrack track;
  for (int i = 0; i <= 60; ++i) {
    motion::PoseSample sample{i * interval};
    sample.X.translation() = Vector3d(0.0, 0.0, any(random));
    track.push(sample);
  }
  EnergyWatch watch(mass, 0.2);
  double x = 0.1, v = 0.0;  // of the body; the spring is unstretched if the body is at the handle
  const int steps = static_cast<int>(std::lround(interval / h));
  const auto look = [&](double t, const motion::MotionSegment& handle) {
    const double stretch = x - handle.body_rate_state(t).X.translation().z();
    watch.look({t, 0.5 * mass * (omega * omega * stretch * stretch + v * v), Vector3d(0.0, 0.0, x),
                Vector3d(0.0, 0.0, v), Vector3d(0.0, 0.0, stretch), is_told ? std::abs(error) : 0.0},
               handle);
  };
  for (int i = 0; i < 50 * steps; ++i) {
    const double t = i * h;
    const motion::MotionSegment& handle = track.segment(t + 0.5 * h);
    if (i == 0) look(t, handle);
    // Driven by the handle's cubic: a particular solution of the same degree plus the oscillation.
    const motion::BodyRateState begin = handle.body_rate_state(t), end = handle.body_rate_state(t + h);
    const double a0 = begin.a_W.z(), a1 = end.a_W.z(), w2 = omega * omega;
    const auto particular = [&](const motion::BodyRateState& m, double a) {
      return m.X.translation().z() - (a + gravity) / w2;
    };
    const double jerk = (a1 - a0) / h;
    const double y = x - particular(begin, a0), y_dot = v - (begin.v_W.z() - jerk / w2);
    const double c = std::cos(omega * h), s = std::sin(omega * h);
    x = particular(end, a1) + y * c + y_dot / omega * s;
    v = end.v_W.z() - jerk / w2 - y * omega * s + y_dot * c;
    v = std::copysign(std::sqrt(v * v + 2.0 * error / mass), v);
    look(t + h, handle);
  }
  return watch;
}

TEST(EnergyWatch, SeesNothingInAnExactMotionHoweverFastItSwingsAndTheHandleTrembles) {
  for (const double omega : {5.0, 100.0, 3e4}) {
    for (const double h : {0.02, 0.002}) {
      for (const double tremor : {0.0, 1e-9, 1e-6, 1e-4}) {
        const EnergyWatch watch = watched(omega, h, tremor, 0.0, false);
        EXPECT_LT(watch.growth(), 1e-9) << omega << ' ' << h << ' ' << tremor;
        EXPECT_TRUE(tremor > 1e-5 || watch.is_certain()) << omega << ' ' << h << ' ' << tremor;
      }
    }
  }
  EXPECT_TRUE(watched(5.0, 0.002, 1e-3, 0.0, false).is_certain());
}

TEST(EnergyWatch, DetectsEnergyGainedBeyondTheHandlesWork) {
  for (const double omega : {100.0, 3e4}) {
    const double most = 0.5 * 2.0 * omega * omega * 0.01;  // [J]; in a hundred steps a thousandth of that, or a tenth
    EXPECT_GT(watched(omega, 0.02, 1e-6, 2e-5 * most, false).growth(), 5e-4) << omega;
    EXPECT_LT(watched(omega, 0.02, 1e-6, 2e-5 * most, true).growth(), 1e-9) << omega;
    EXPECT_NEAR(watched(omega, 0.02, 1e-6, 2e-5 * most, true).estimates(), 1e-3, 1e-4) << omega;
    EXPECT_GT(watched(omega, 0.02, 1e-6, 2e-3 * most, true).growth(), 0.05) << omega;
  }
}

TEST(StabilityMap, EnergyIsJudgedWhileTheHandTremblesAndNotWhileItTurns) {
  StabilityCell cell;
  cell.damping_ratio = 0.05;
  cell.step = 0.001;
  cell.seconds = 0.5;
  cell.dofs = {true, true, true};
  for (const auto& [tail, judged] :
       {std::pair{MapTail::rest, true}, std::pair{MapTail::micrometre, true},
        std::pair{MapTail::tenth_of_a_millimetre, true}, std::pair{MapTail::lissajous, false}}) {
    cell.tail = tail;
    const StabilityOutcome outcome = run_cell("exponential", "linear", cell);
    EXPECT_EQ(outcome.energy_judged, judged) << name_of(tail);
    EXPECT_TRUE(outcome.held()) << name_of(tail) << ' ' << outcome.energy_growth << ' ' << outcome.energy_estimated;
  }
}

TEST(StabilityMap, ExplicitMethodsHoldOnTheirOwnBelowTheirLimitOnOneSpringAndNotAboveIt) {
  // ζ = 1: semi-implicit Euler with explicit damping to ω h = 0.828, RK4 to 2.785; the paper's scheme has no
  // limit.
  for (const auto& [name, limit] : {std::pair{"semi_implicit_euler", 0.828}, std::pair{"rk4", 2.785}}) {
    EXPECT_TRUE(run_cell(name, "linear", cell_with(0.5 * limit, MapTail::millimetre)).held_on_its_own()) << name;
    EXPECT_FALSE(run_cell(name, "linear", cell_with(3.0 * limit, MapTail::rest)).held_on_its_own()) << name;
  }
  for (const double omega_step : {0.5, 5.0, 500.0}) {
    EXPECT_TRUE(run_cell("paper", "linear", cell_with(omega_step, MapTail::lissajous)).held()) << omega_step;
  }
}

TEST(StabilityMap, AStepByTheFallbackOrAtAStopHoldsButNotOnItsOwnWhateverTheIntegrator) {
  StabilityOutcome outcome;
  EXPECT_TRUE(outcome.held() && outcome.held_on_its_own());
  for (int StabilityOutcome::*counter :
       {&StabilityOutcome::stops, &StabilityOutcome::fallback, &StabilityOutcome::substeps}) {
    StabilityOutcome counted;
    counted.*counter = 1;
    EXPECT_TRUE(counted.held() && !counted.held_on_its_own());
  }
  // Far above its limit RK4 leaves the rod's range; that counts apart, not as a rejected step.
  const StabilityOutcome rk4 = run_cell("rk4", "linear", cell_with(30.0, MapTail::rest));
  EXPECT_GT(rk4.stops + rk4.fallback, 0);
  EXPECT_EQ(rk4.rejected, 0);
}

TEST(StabilityMap, ManyHalvedStepsInALongFallAddNoEnergy) {
  StabilityCell cell;
  cell.stiffness_factor = 1e-6;
  cell.mass = 1e6;
  cell.step = 0.05;
  cell.damping_ratio = 0.0;
  cell.dofs = {true, true, false};
  cell.hand = MapHand::jump;
  cell.seconds = 1.0;
  EXPECT_LT(run_cell("implicit_euler", "linear", cell).energy_growth, 1e-10);
  EXPECT_LT(run_cell("exponential", "linear", cell).energy_growth, 1e-10);
  // Its estimate, a tenth of the difference between two half steps and a whole one, may be several times too small.
  EXPECT_LT(run_cell("rosenbrock", "linear", cell).energy_growth, 1e-4);
}

TEST(StabilityMap, OutcomesAreOrderedByWhatIsWorst) {
  const auto outcome = [](bool finite, bool bounded, double growth, int rejected) {
    StabilityOutcome o;
    o.finite = finite;
    o.bounded = bounded;
    o.energy_growth = growth;
    o.rejected = rejected;
    return o;
  };
  const std::vector<StabilityOutcome> worst_first = {outcome(false, false, 0.0, 0), outcome(true, false, 0.0, 9),
                                                     outcome(true, true, 2.0, 0),   outcome(true, true, 1e-3, 9),
                                                     outcome(true, true, 1e-10, 9), outcome(true, true, 9e-10, 1)};
  for (std::size_t i = 0; i < worst_first.size(); ++i) {
    for (std::size_t j = 0; j < worst_first.size(); ++j)
      EXPECT_EQ(worse(worst_first[i], worst_first[j]), i < j) << i << " " << j;
  }
}

TEST(StabilityMap, EveryPairOfValuesIsMetByEachIntegrator) {
  const StabilityPlan plan = stability_plan(false);
  const std::size_t values[] = {plan.stiffness_factors.size(),
                                plan.masses.size(),
                                plan.steps.size(),
                                plan.damping_ratios.size(),
                                plan.dofs.size(),
                                plan.hands.size(),
                                plan.tails.size()};
  for (const std::string& integrator : plan.integrators) {
    std::vector<std::vector<double>> cells;
    for (const double factor : plan.stiffness_factors) {
      for (const StabilityCell& c : cells_of(plan, integrator, factor)) {
        const rod::ForkDofs& on = c.dofs;
        cells.push_back({c.stiffness_factor, c.mass, c.step, c.damping_ratio,
                         on.stretch + 2.0 * on.bend + 4.0 * on.torsion, static_cast<double>(c.hand),
                         static_cast<double>(c.tail)});
      }
    }
    const bool is_default = integrator == "exponential";
    EXPECT_EQ(cells.size(), is_default ? 4000 : 500);
    for (std::size_t a = 0; a < std::size(values); ++a) {
      for (std::size_t b = 0; b < a; ++b) {
        std::set<std::pair<double, double>> met;
        for (const std::vector<double>& cell : cells) met.insert({cell[a], cell[b]});
        EXPECT_EQ(met.size(), values[a] * values[b]) << integrator << ' ' << a << ' ' << b;
      }
    }
  }
}

TEST(StabilityMap, TheFullMapHasEveryCombinationOnce) {
  StabilityPlan plan = stability_plan(true);
  std::set<std::tuple<std::string, double, double, double, double, int, MapHand, MapTail>> met;
  for (std::size_t i = 0; i < full_map_size(plan); ++i) {
    const StabilityRun one = full_map_cell(plan, i);
    const StabilityCell& c = one.cell;
    const int on = c.dofs.stretch + 2 * c.dofs.bend + 4 * c.dofs.torsion;
    met.insert({one.integrator, c.stiffness_factor, c.mass, c.step, c.damping_ratio, on, c.hand, c.tail});
  }
  EXPECT_EQ(met.size(), full_map_size(plan));
}

TEST(StabilityMap, TheFullMapGoesOnWhereItWasStopped) {
  StabilityPlan plan = stability_plan(true);
  plan.seconds = 0.05;
  const test_support::TemporaryFolder folder;
  std::ostringstream log;
  const auto lines_of = [&](const std::string& name) {
    std::ifstream in(folder.path(name));
    std::set<std::string> lines;
    // without the processor time, which is last
    for (std::string line; std::getline(in, line);) lines.insert(line.substr(0, line.rfind('\t')));
    return lines;
  };
  EXPECT_EQ(run_full_map(plan, folder.path("whole"), 12, log).size(), 12U);
  EXPECT_EQ(run_full_map(plan, folder.path("parts"), 5, log).size(), 5U);
  std::ofstream(folder.path("parts"), std::ios::app) << "5\ta line that was cut";
  const std::vector<StabilityRun> all = run_full_map(plan, folder.path("parts"), 7, log);
  EXPECT_EQ(all.size(), 12U);
  EXPECT_EQ(lines_of("parts"), lines_of("whole"));
  int cells = 0;
  for (const StabilityRow& row : map_of(all).rows) cells += row.cells + row.cannot_fail;
  EXPECT_EQ(cells, 12);
  plan.masses = {2.0};
  EXPECT_THROW(run_full_map(plan, folder.path("parts"), 1, log), validation::InputError);
}

TEST(StabilityMap, NothingCanFailWhereNothingIsIntegrated) {
  StabilityPlan plan = stability_plan(true);
  plan.integrators = {"semi_implicit_euler"};
  plan.masses = {0.0};
  plan.stiffness_factors = {1e12};
  std::ostringstream log;
  Progress progress(log, false, unit_count(plan));
  Units units(progress, Shard{});
  StabilityPlan rigid = plan;
  rigid.masses = {1.0};
  rigid.dofs = {{false, false, false}};
  for (const StabilityPlan& one : {plan, rigid}) {
    const StabilityMap map = stability_map(one, units);
    EXPECT_TRUE(map.failures.empty());
    std::size_t drawn = 0;
    for (const StabilityRow& row : map.rows) {
      EXPECT_EQ(row.cells, 0);
      drawn += static_cast<std::size_t>(row.cannot_fail);
    }
    EXPECT_EQ(drawn, cells_of(one, "semi_implicit_euler", 1e12).size());
    EXPECT_GT(drawn, 0U);
  }
}

}  // namespace
}  // namespace spring_workbench::benchmark::rods_test
