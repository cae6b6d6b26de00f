#include "benchmark/peers.h"

#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <cstdlib>

#include "benchmark/error_table.h"
#include "benchmark/reference_solution.h"
#include "benchmark/stepping_loop.h"

namespace spring_workbench::benchmark {
namespace {

const Peers& peers() {
  static const Peers instance = all_peers();
  return instance;
}

bool is_weld(const Method& method) { return method.name() == "mujoco_weld"; }

double error_at(const Method& method, const Scenario& scene, int steps_per_interval) {
  const RunResult run = run_isolated(method, scene, scene.output_interval / steps_per_interval, {}, 60.0);
  return run.finite ? output_error(scene, reference_solution(scene), run.outputs) : 1e300;
}

TEST(Peers, NamesAreUnique) {
  for (const MethodPtr& a : peers().methods) {
    for (const MethodPtr& b : peers().methods) EXPECT_EQ(a->name() == b->name(), a.get() == b.get());
  }
}

TEST(Peers, EachFixedStepPeerConvergesToTheSceneWhoseLawItHasWithItsOrder) {
  for (const Scenario& scene : {stretch_scene(1e3), torsion_scene(10.0), six_dof_scene(1.0)}) {
    for (const MethodPtr& method : peers().methods) {
      if (method->knob() != Method::Knob::step || !method->has_scene_law(scene) || is_weld(*method)) continue;
      const bool runge_kutta = method->name().find("rk4") != std::string::npos;
      const bool engine = method->name().find("hand_") != 0;
      const double order = !runge_kutta ? 1.0 : (engine && scene.kind == SceneKind::six_dof ? 2.0 : 4.0);
      const int steps = order > 2.0 ? 8 : 32;
      const double coarse = error_at(*method, scene, steps), fine = error_at(*method, scene, 2 * steps);
      EXPECT_LT(coarse, 5e-3) << method->name() << " in " << scene.name;
      EXPECT_NEAR(std::log2(coarse / fine), order, 0.3) << method->name() << " in " << scene.name;
    }
  }
}

TEST(Peers, OtherRotationParametrisationsAgreeWithTheSceneWhereTheSpringIsStiff) {
  // The deflection is a hundredth of a radian: parametrisations differ by its square. Bullet's constraint damps the
  // velocities of the two centres instead of the grip's, and is another law at any stiffness.
  const Scenario scene = six_dof_scene(100.0);
  const ReferenceSolution reference = reference_solution(scene);
  for (const MethodPtr& method : peers().methods) {
    if (method->has_scene_law(scene) || is_weld(*method)) continue;
    const ReferenceSolution own = own_solution(*method, scene, 128, 60.0);
    ASSERT_FALSE(own.outputs.empty()) << method->name();
    const double allowed = method->name().find("bullet") == 0 ? 0.3 : 1e-3;
    EXPECT_LT(output_error(scene, reference, own.outputs), allowed * reference.largest_deflection) << method->name();
    EXPECT_LT(own.uncertainty, 1e-2 * reference.largest_deflection) << method->name();
  }
}

TEST(Peers, CvodeIsAsGoodAsItsToleranceOverTheHandsMotion) {
  for (const Scenario& scene : {stretch_scene(1e4), torsion_scene(1e2), six_dof_scene(1.0), six_dof_scene(1e4)}) {
    const ReferenceSolution reference = reference_solution(scene);
    for (const double tolerance : {1e-6, 1e-9}) {
      for (const MethodPtr& method : cvode_peers()) {
        const RunResult run = run_isolated(*method, scene, tolerance, {}, 60.0);
        ASSERT_TRUE(run.finite) << method->name();
        EXPECT_LT(output_error(scene, reference, run.outputs), 1e3 * tolerance) << method->name();
      }
    }
  }
}

TEST(Peers, AWeldToAMocapBodyLagsByTheDampersShareOfTheHandsSpeed) {
  const Scenario scene = stretch_scene(1e4);
  const double Omega = scalar_hand(scene, 0.0).rate / hand_amplitude(scene);
  const std::complex<double> i(0.0, 1.0);
  const std::complex<double> compliance =
      1.0 / (scene.stiffness[2] - scene.mass * Omega * Omega + i * Omega * scene.damping[2]);
  const double lag = std::abs(compliance * scene.damping[2] * scalar_hand(scene, 0.0).rate);
  for (const MethodPtr& method : peers().methods) {
    if (!is_weld(*method)) continue;
    EXPECT_NEAR(error_at(*method, scene, 64), lag, 0.01 * lag);
  }
}

/// A method that ends in the way given.
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
  const Repetition three{3, 0.05};
  EXPECT_TRUE(wants_another(three, 2, 0.06));
  EXPECT_TRUE(wants_another(three, 1000, 0.049));
  EXPECT_FALSE(wants_another(three, 3, 0.05));
  EXPECT_FALSE(wants_another(three, 1, 1.01 * kMostSeconds));
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
}  // namespace spring_workbench::benchmark
