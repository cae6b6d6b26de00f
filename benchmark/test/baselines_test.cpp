#include "benchmark/baselines.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <cstdio>
#include <cstdlib>
#include <functional>

#include "benchmark/error_table.h"
#include "benchmark/ode_solver.h"
#include "benchmark/reference_solution.h"
#include "benchmark/solver_run.h"
#include "benchmark/stepping_loop.h"

namespace spring_workbench::benchmark::baselines_test {
namespace {

const Baselines& baselines() {
  static const Baselines instance = all_baselines();
  return instance;
}

bool is_weld(const Method& method) { return method.name() == "mujoco_weld"; }

double error_at(const Method& method, const Scenario& scene, int steps_per_interval) {
  const RunResult run = run_isolated(method, scene, scene.output_interval / steps_per_interval, {}, 60.0);
  return run.finite ? output_error(scene, reference_solution(scene), run.outputs) : 1e300;
}

TEST(Baselines, EveryEngineIsFoundOrNamedAsNotFoundAndTheSolversAreThere) {
  std::size_t named = 0;
  for (const std::vector<std::string>* names : {&baselines().found, &baselines().not_found}) {
    for (const std::string& name : *names) named += name.find("implicitfast") == std::string::npos ? 1 : 0;
  }
  EXPECT_EQ(named, 5U);
  EXPECT_GE(baselines().methods.size(), 2U + 2U + 9U + baselines().found.size() - 1U);
}

TEST(Baselines, NamesAreUnique) {
  for (const MethodPtr& a : baselines().methods) {
    for (const MethodPtr& b : baselines().methods) EXPECT_EQ(a->name() == b->name(), a.get() == b.get());
  }
}

TEST(Baselines, EachFixedStepBaselineConvergesToTheSceneWhoseLawItHasWithItsOrder) {
  std::size_t runs = 0;
  for (const Scenario& scene : {stretch_scene(1e3), torsion_scene(10.0), six_dof_scene(1.0)}) {
    for (const MethodPtr& method : baselines().methods) {
      if (method->knob() != Method::Knob::step || !method->has_scene_law(scene) || is_weld(*method)) continue;
      const bool runge_kutta = method->name().find("rk4") != std::string::npos;
      const bool engine = method->name().find("mujoco") == 0;
      const double order = !runge_kutta ? 1.0 : (engine && scene.kind == SceneKind::six_dof ? 2.0 : 4.0);
      const int steps = order > 2.0 ? 8 : 32;
      const double coarse = error_at(*method, scene, steps), fine = error_at(*method, scene, 2 * steps);
      EXPECT_LT(coarse, 5e-3) << method->name() << " in " << scene.name;
      EXPECT_NEAR(std::log2(coarse / fine), order, 0.3) << method->name() << " in " << scene.name;
      ++runs;
    }
  }
  // The hand-written ones, solver_rk4 and solver_implicit_euler in three scenes, each engine at least in A and B;
  // SUNDIALS is none.
  EXPECT_GE(runs, 3U * 4U + 2U * (baselines().found.size() - 1U));
}

TEST(Baselines, OtherRotationParametrisationsAgreeWithTheSceneWhereTheSpringIsStiff) {
  // The deflection is a hundredth of a radian, and parametrisations differ by its square. Bullet's constraint damps the
  // velocities of the two centres instead of that of the grip, which is a different law at any stiffness.
  if (baselines().found.size() == 1) GTEST_SKIP() << "no engine was found";
  const Scenario scene = six_dof_scene(100.0);
  const ReferenceSolution reference = reference_solution(scene);
  for (const MethodPtr& method : baselines().methods) {
    if (method->has_scene_law(scene) || is_weld(*method)) continue;
    const ReferenceSolution own = own_solution(*method, scene, 128, 60.0);
    ASSERT_FALSE(own.outputs.empty()) << method->name();
    const double allowed = method->name().find("bullet") == 0 ? 0.3 : 1e-3;
    EXPECT_LT(output_error(scene, reference, own.outputs), allowed * reference.largest_deflection) << method->name();
    EXPECT_LT(own.uncertainty, 1e-2 * reference.largest_deflection) << method->name();
  }
}

TEST(Baselines, GeneralSolversAreAsGoodAsTheirToleranceOverTheHandsMotionHoweverItIsKnown) {
  std::vector<MethodPtr> methods = cvode_baselines();
  for (MethodPtr& method : solver_baselines()) methods.push_back(std::move(method));
  std::size_t runs = 0;
  for (const Scenario& scene : {stretch_scene(1e4), torsion_scene(1e2), six_dof_scene(1.0), six_dof_scene(1e4),
                                with_sampled_hand(six_dof_scene(1.0)), with_sampled_hand(torsion_scene(1e2))}) {
    const ReferenceSolution reference = reference_solution(scene);
    for (const MethodPtr& method : methods) {
      if (method->knob() != Method::Knob::tolerance || !method->runs_on(scene)) continue;
      // Where a step goes through samples, its error test may not see that the hand's acceleration jumps there.
      const bool sees_all = !scene.samples || !runs_through(method->name());
      double coarse = 0.0;
      for (const double tolerance : {1e-6, 1e-9}) {
        const RunResult run = run_isolated(*method, scene, tolerance, {}, 60.0);
        ASSERT_TRUE(run.finite) << method->name() << scene.name << scene.stiffness_factor;
        const double error = output_error(scene, reference, run.outputs);
        EXPECT_LT(error, (sees_all ? 3e2 : 1e4) * tolerance)
            << method->name() << ' ' << scene.name << ' ' << scene.stiffness_factor;
        // A thousandth of the tolerance, unless no digits are left.
        if (coarse > 0.0 && sees_all) {
          EXPECT_LT(error, std::max(0.1 * coarse, 1e-11)) << method->name() << ' ' << scene.name;
        }
        coarse = error;
        ++runs;
      }
    }
  }
  // Five more on samples, where CVODE is restarted, and three others are not.
  EXPECT_EQ(runs, 2U * (4U * 8U + 2U * 13U));
}

/// Error of a solver for the oscillator y'' = −y, evaluated between the ends of its steps.
double oscillator_error(const std::function<std::unique_ptr<OdeSolver>(int, OdeSolver::Rates)>& make, double tolerance,
                        double every) {
  const auto solver = make(2, [](double, const double* y, double* rate) {
    rate[0] = y[1];
    rate[1] = -y[0];
    return true;
  });
  solver->begin(0.0, {1.0, 0.0}, tolerance, {1.0, 1.0});
  double error = 0.0;
  for (int i = 1; i * every <= 10.0; ++i) {
    error = std::max(error, std::abs(solver->advance(i * every, kNever)[0] - std::cos(i * every)));
  }
  return error;
}

TEST(Solvers, Dop853AndRadauInterpolateAsWellAsTheyStep) {
  for (const auto make : {&make_dop853, &make_radau}) {
    for (const double tolerance : {1e-3, 1e-6, 1e-9}) {
      const double rarely = oscillator_error(make, tolerance, 5.0), often = oscillator_error(make, tolerance, 0.01);
      EXPECT_LT(rarely, 100.0 * tolerance);
      EXPECT_LT(often, 100.0 * tolerance);
    }
  }
}

TEST(Solvers, Dop853TakesAsManyEvaluationsAsItsOrderSays) {
  // Order eight: a thousand times the accuracy for 1000^(1/8) = 2.4 times the steps.
  std::array<long, 2> evaluations{};
  for (std::size_t i = 0; i < 2; ++i) {
    const auto solver = make_dop853(2, [&](double, const double* y, double* rate) {
      rate[0] = y[1];
      rate[1] = -y[0];
      ++evaluations[i];
      return true;
    });
    solver->begin(0.0, {1.0, 0.0}, i == 0 ? 1e-6 : 1e-9, {1.0, 1.0});
    solver->advance(100.0, 100.0);
  }
  EXPECT_GT(evaluations[1], 1.8 * static_cast<double>(evaluations[0]));
  EXPECT_LT(evaluations[1], 3.0 * static_cast<double>(evaluations[0]));
}

TEST(Solvers, RadauAndTheImplicitOnesDoNotNeedShortStepsWhereTheEquationIsStiff) {
  constexpr double stiff = 1e6;
  const auto counted = [&](const std::function<std::unique_ptr<OdeSolver>(int, OdeSolver::Rates)>& make) {
    long evaluations = 0;
    const auto solver = make(1, [&](double t, const double* y, double* rate) {
      rate[0] = -stiff * (y[0] - std::cos(t)) - std::sin(t);
      ++evaluations;
      return true;
    });
    solver->begin(0.0, {1.0}, 1e-6, {1.0});
    EXPECT_NEAR(solver->advance(10.0, 10.0)[0], std::cos(10.0), 1e-4);
    return evaluations;
  };
  EXPECT_LT(counted(&make_radau), 3000);
  EXPECT_LT(counted([](int n, OdeSolver::Rates rates) { return make_arkode(true, n, std::move(rates)); }), 20000);
  EXPECT_GT(counted(&make_dop853), 1000000);
}

TEST(SteppingLoop, LongStepsAreInterpolatedToTheirOrder) {
  // A polynomial of degree five is reproduced everywhere.
  std::vector<Vector3d> values;
  const auto quintic = [](double t) { return Vector3d(std::pow(t - 3.0, 5), t, 1.0); };
  for (int i = 0; i < 12; ++i) values.push_back(quintic(i));
  for (double t = 0.0; t <= 11.0; t += 0.13) EXPECT_LT((between_steps(values, t) - quintic(t)).norm(), 1e-7) << t;
  const Scenario scene = stretch_scene(1e2);
  for (const MethodPtr& method : hand_written_baselines()) {
    if (method->name() != "hand_rk4") continue;
    const ReferenceSolution reference = reference_solution(scene);
    const auto error = [&](double outputs) {
      return output_error(scene, reference, method->run(scene, outputs * scene.output_interval).outputs);
    };
    EXPECT_NEAR(std::log2(error(4.0) / error(2.0)), 4.0, 0.7);
    EXPECT_LT(error(2.0), 16.0 * 1.5 * error(1.0));
  }
}

TEST(Baselines, MujocoHasItsFastImplicitModeSince233AndItStepsAsEulerWhereOnlyJointsAreDamped) {
  std::array<int, 3> version{};
  for (const std::string& found : baselines().found) {
    std::sscanf(found.c_str(), "MuJoCo %d.%d.%d", &version[0], &version[1], &version[2]);
  }
  if (version == std::array<int, 3>{}) GTEST_SKIP() << "MuJoCo was not found";
  const auto is_fast = [](const std::string& name) { return name == "mujoco_joints_implicitfast"; };
  const Method *euler = nullptr, *fast = nullptr;
  for (const MethodPtr& method : baselines().methods) {
    if (method->name() == "mujoco_joints_euler") euler = method.get();
    if (is_fast(method->name())) fast = method.get();
  }
  const bool has_fast = version >= std::array<int, 3>{2, 3, 3};
  ASSERT_EQ(fast != nullptr, has_fast);
  EXPECT_EQ(
      std::count_if(baselines().drags.begin(), baselines().drags.end(), [&](const auto& d) { return is_fast(d.name); }),
      has_fast ? 1 : 0);
  if (!has_fast) return;
  // Both take the joints' damping implicitly, and leave out how Coriolis forces change with velocity.
  for (const Scenario& scene : {stretch_scene(1e4), torsion_scene(1.0), six_dof_scene(1.0)}) {
    const RunResult a = euler->run(scene, 1e-3), b = fast->run(scene, 1e-3);
    ASSERT_TRUE(a.finite && b.finite) << scene.name;
    EXPECT_LT((a.outputs.back() - b.outputs.back()).norm(), 1e-9) << scene.name;
  }
}

TEST(Baselines, AWeldToAMocapBodyLagsByTheDampersShareOfTheHandsSpeed) {
  const Scenario scene = stretch_scene(1e4);
  const double Omega = scalar_hand(scene, 0.0).rate / hand_amplitude(scene);
  const std::complex<double> i(0.0, 1.0);
  const std::complex<double> compliance =
      1.0 / (scene.stiffness[2] - scene.mass * Omega * Omega + i * Omega * scene.damping[2]);
  const double lag = std::abs(compliance * scene.damping[2] * scalar_hand(scene, 0.0).rate);
  for (const MethodPtr& method : baselines().methods) {
    if (!is_weld(*method)) continue;
    EXPECT_NEAR(error_at(*method, scene, 64), lag, 0.01 * lag);
  }
}

/// A method that fails in the given manner.
class Broken : public Method {
 public:
  explicit Broken(bool aborts) : aborts_(aborts) {}
  std::string name() const override { return "broken"; }
  RunResult run(const Scenario& scene, double step) const override {
    if (aborts_) std::abort();
    double x = 1.0;
    return stepping_loop(
        scene, step, [&](double, double) { x *= 10.0; }, [&](double) { return Vector3d::Constant(x); });
  }

 private:
  bool aborts_;
};

TEST(Method, OneThatAbortsOrDivergesIsNotFiniteAndTheCallerLives) {
  for (const bool aborts : {true, false}) {
    const RunResult run = run_isolated(Broken(aborts), stretch_scene(1e4), 0.02, Repetition{3, 0.0}, 10.0);
    EXPECT_FALSE(run.finite);
    EXPECT_FALSE(std::isfinite(run.wall_seconds));
  }
}

TEST(Method, RunsAreRepeatedUntilThereAreEnoughOfThemAndEnoughTimeButNoLonger) {
  const Repetition three{3, 0.005};
  EXPECT_TRUE(wants_another(three, 2, 0.006));
  EXPECT_TRUE(wants_another(three, 1000, 0.0049));
  EXPECT_FALSE(wants_another(three, 3, 0.005));
  EXPECT_FALSE(wants_another(three, 1, 1.01 * kMaxSeconds));
  EXPECT_FALSE(wants_another({}, 1, 0.0));
}

TEST(Method, StepsDivideTheOutputIntervalAndAreNeverLongerThanAsked) {
  const Scenario scene = six_dof_scene(1.0);
  for (const double step : {0.02, 0.019, 0.01, 1.0 / 240.0, 1e-3, 3.3e-5, 0.02 / 8192}) {
    const int n = steps_per_output(scene, step);
    EXPECT_LE(scene.output_interval / n, step * (1.0 + 1e-9));
    EXPECT_GT(scene.output_interval / std::max(n - 1, 1) * (n > 1 ? 1.0 : 1e9), step * (1.0 - 1e-9));
  }
}

}  // namespace
}  // namespace spring_workbench::benchmark::baselines_test
