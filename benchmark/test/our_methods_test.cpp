#include "benchmark/our_methods.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "benchmark/function_hand.h"
#include "benchmark/reference_solution.h"
#include "benchmark/rod_case.h"
#include "benchmark/stepping_loop.h"
#include "spring_workbench/dynamics/integrator.h"
#include "spring_workbench/math/so3.h"
#include "spring_workbench/validation/names.h"

namespace spring_workbench::benchmark::our_methods_test {
namespace {

double error_at(const Method& method, const Scenario& scene, int steps_per_interval) {
  const RunResult run = method.run(scene, scene.output_interval / steps_per_interval);
  return run.finite ? output_error(scene, reference_solution(scene), run.outputs) : 1e300;
}

/// Error of the integrator alone, which evaluates the hand's motion at any time instead of using poses.
double integrator_error(const std::string& name, const Scenario& scene, int steps_per_interval) {
  const dynamics::HeldBody body = held_body(rod_case(scene), "bushing");
  const auto integrator =
      dynamics::make_integrator(validation::named<dynamics::IntegratorKind>(name, "benchmark", "integrator"));
  const FunctionHand hand(scene);
  dynamics::StrainState state = body.zero_state();
  const RunResult run = stepping_loop(
      scene, scene.output_interval / steps_per_interval,
      [&](double t, double h) { integrator->step(body, hand, t, h, state); },
      [&](double t) -> Vector3d {
        const dynamics::HandleState handle = body.state_at(hand, t);
        if (scene.kind != SceneKind::torsion) return body.object(handle, state).X.translation();
        return {0.0, 0.0, math::log_so3(handle.X_WH.linear()).z() + state.q[0]};  // not limited to half a turn
      });
  return run.finite ? output_error(scene, reference_solution(scene), run.outputs) : 1e300;
}

TEST(OurMethods, EveryIntegratorIsThere) {
  const std::vector<MethodPtr> methods = our_methods();
  ASSERT_EQ(methods.size(), validation::names<dynamics::IntegratorKind>().size());
  for (const std::string& name : validation::names<dynamics::IntegratorKind>()) {
    EXPECT_EQ(std::count_if(methods.begin(), methods.end(), [&](const auto& m) { return m->name() == name; }), 1);
  }
}

int order_of(const std::string& name) {
  return dynamics::make_integrator(validation::named<dynamics::IntegratorKind>(name, "benchmark", "integrator"))
      ->order();
}

TEST(OurMethods, EachConvergesToTheReferencesWithItsOrder) {
  for (const Scenario& scene : {stretch_scene(1e3), torsion_scene(10.0), six_dof_scene(1.0)}) {
    for (const MethodPtr& method : our_methods()) {
      if (!method->has_scene_law(scene)) continue;
      // With a single spring the paper's load, the mean over a step, gives one order more.
      const int order = method->name() == "paper" ? 2 : order_of(method->name());
      if (order > 4) continue;
      // Coarse enough that the error is far above that of the references, fine enough that explicit methods are stable.
      const int steps = order < 2 ? 32 : method->name() == "rosenbrock" ? 1 : scene.kind == SceneKind::six_dof ? 4 : 2;
      const double coarse = integrator_error(method->name(), scene, steps),
                   fine = integrator_error(method->name(), scene, 2 * steps);
      EXPECT_LT(coarse, 5e-3) << method->name() << " in " << scene.name;
      EXPECT_NEAR(std::log2(coarse / fine), order, 0.3) << method->name() << " in " << scene.name << " " << fine;
    }
  }
}

/// At critical damping, where both rates of a mode are one: from 20 to 0.6 ms, to rounding.
TEST(OurMethods, ExponentialHasNoFloorAtCriticalDamping) {
  for (const Scenario& scene : {stretch_scene(1e2), torsion_scene(1.0)}) {
    const double amplitude = hand_amplitude(scene);
    double error = integrator_error("exponential", scene, 1) / amplitude;
    for (const int steps : {2, 4, 8, 16, 32}) {
      const double finer = integrator_error("exponential", scene, steps) / amplitude;
      EXPECT_LT(finer, std::max(error, 1e-13)) << scene.name << " " << steps;
      error = finer;
    }
    EXPECT_LT(error, 1e-13) << scene.name;
  }
}

/// From 100 to 5 ms.
TEST(OurMethods, TheErrorOfExponentialFallsWithEachOfTwentySteps) {
  Scenario scene = six_dof_scene(1.0);
  scene.output_interval = 0.1;
  double error = integrator_error("exponential", scene, 1);
  for (int steps = 2; steps <= 20; ++steps) {
    const double finer = integrator_error("exponential", scene, steps);
    EXPECT_LT(finer, error) << steps;
    error = finer;
  }
}

TEST(OurMethods, ThoseOfHighOrderHaveItToo) {
  // From 20 to 5 ms; the transient of the hand's jerk at the start costs part of an order.
  const Scenario scene = six_dof_scene(1.0);
  int seen = 0;
  for (const MethodPtr& method : our_methods()) {
    const int order = order_of(method->name());
    if (order <= 4) continue;
    ++seen;
    const double coarse = integrator_error(method->name(), scene, 1), fine = integrator_error(method->name(), scene, 4);
    EXPECT_LT(coarse, 1e-7) << method->name();
    EXPECT_GT(0.5 * std::log2(coarse / fine), order - 1.0) << method->name() << ' ' << coarse << ' ' << fine;
  }
  EXPECT_EQ(seen, 1);
}

TEST(OurMethods, ExponentialIsAccurateInOneCoordinateWhateverStiffnessStepAndDamping) {
  std::vector<Scenario> scenes;
  for (const double zeta : {0.1, 1.0, 3.0}) {
    for (int decade = 0; decade <= 8; ++decade) {
      scenes.push_back(stretch_scene(std::pow(10.0, decade), zeta));
      scenes.push_back(torsion_scene(std::pow(10.0, decade - 1), zeta));
    }
  }
  for (const MethodPtr& method : our_methods()) {
    if (method->name() != "exponential") continue;
    for (const Scenario& scene : scenes) {
      for (const int steps : {1, 3, 16}) {
        EXPECT_LT(integrator_error(method->name(), scene, steps), 1e-7 * hand_amplitude(scene))
            << scene.name << " × " << scene.stiffness_factor << ", zeta " << scene.damping_ratio << ", " << steps;
      }
    }
  }
}

TEST(OurMethods, AHandThatIsAFunctionIsMetBetterTheMoreOfItsPosesAreGiven) {
  // Simulation interpolates between two poses, which differs from the function; on soft springs this error falls with
  // the fourth power of the interval.
  for (const MethodPtr& method : our_methods()) {
    if (method->name() != "exponential") continue;
    for (const Scenario& scene : {stretch_scene(1e2), torsion_scene(1.0), six_dof_scene(1.0)}) {
      const double coarse = error_at(*method, scene, 1), fine = error_at(*method, scene, 4);
      EXPECT_LT(coarse, 2e-5) << scene.name;
      EXPECT_NEAR(0.5 * std::log2(coarse / fine), 4.0, 0.3) << scene.name << ' ' << coarse << ' ' << fine;
    }
  }
}

TEST(OurMethods, ASampledHandIsSimulatedToTheReferenceOnItsMotionAndTheRestIsNotForStepsToLower) {
  // The reference is independent of Simulation. The hand between samples is known to second order in their interval,
  // except for the first one, whose velocity is that of the chord.
  for (const double factor : {1.0, 100.0}) {
    const Scenario slow = with_sampled_hand(six_dof_scene(factor));
    Scenario fast = slow;
    fast.output_interval = 0.5 * slow.output_interval;
    fast = with_sampled_hand(fast);
    const ReferenceSolution reference = reference_solution(slow);
    EXPECT_GT(reference.hand_error / reference_solution(fast).hand_error, 1.7);
    for (const MethodPtr& method : our_methods()) {
      if (method->name() != "exponential") continue;
      EXPECT_LT(error_at(*method, slow, 1), 0.1 * reference.hand_error);
      EXPECT_LT(error_at(*method, slow, 8), 1e-9 + 10.0 * reference.uncertainty);
    }
  }
}

}  // namespace
}  // namespace spring_workbench::benchmark::our_methods_test
