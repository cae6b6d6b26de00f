#include "benchmark/our_methods.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "benchmark/dense_strain.h"
#include "benchmark/reference_solution.h"
#include "spring_workbench/dynamics/integrator.h"
#include "spring_workbench/validation/names.h"

namespace spring_workbench::benchmark {
namespace {

bool knows_function(const Method& method) { return method.hand() == "function"; }

double error_at(const Method& method, const Scenario& scene, int steps_per_interval) {
  const RunResult run = method.run(scene, scene.output_interval / steps_per_interval);
  return run.finite ? output_error(scene, reference_solution(scene), run.outputs) : 1e300;
}

TEST(DenseStrain, IsExactForPolynomialsOfDegreeElevenOnUnevenSteps) {
  for (const int size : {1, 5, 6}) {
    const auto power = [](int c, int n, double t) { return std::pow(0.5 * (1.0 - 0.15 * (c + 1) * t), n); };
    DenseStrain dense;
    EXPECT_LT(dense.known_until(), -1e300);
    for (const double t : {0.0, 0.1, 0.25, 0.3, 0.5, 0.8, 0.95}) {
      dynamics::StrainState s{rod::StrainVector(size), rod::StrainVector(size)};
      for (int c = 0; c < size; ++c) {
        s.q[c] = power(c, 11, t);
        s.q_dot[c] = -11.0 * 0.075 * (c + 1) * power(c, 10, t);
      }
      dense.push(t, s);
    }
    EXPECT_EQ(dense.known_until(), 0.5);
    for (int i = 0; i < 25; ++i) {
      const math::Pack t{0.02 * i, 0.02 * i + 0.005, 0.02 * i + 0.01, 0.02 * i + 0.015};
      math::Pack q[rod::max_strain_coordinates];
      dense.at(t, q);
      for (int c = 0; c < size; ++c) {
        for (int lane = 0; lane < math::pack_size; ++lane) EXPECT_NEAR(q[c][lane], power(c, 11, t[lane]), 1e-14);
      }
    }
  }
}

TEST(OurMethods, EveryIntegratorIsThereWithBothHands) {
  const std::vector<MethodPtr> methods = our_methods();
  EXPECT_EQ(methods.size(), 2 * validation::names<dynamics::IntegratorKind>().size());
  for (const std::string& name : validation::names<dynamics::IntegratorKind>()) {
    for (const char* hand : {"function", "samples"}) {
      EXPECT_EQ(std::count_if(methods.begin(), methods.end(),
                              [&](const auto& m) { return m->name() == name && m->hand() == hand; }),
                1);
    }
  }
}

TEST(OurMethods, EachConvergesToTheReferencesWithItsOrder) {
  for (const Scenario& scene : {stretch_scene(1e3), torsion_scene(10.0), six_dof_scene(1.0)}) {
    for (const MethodPtr& method : our_methods()) {
      if (!knows_function(*method) || !method->has_scene_law(scene)) continue;
      // With a single spring the paper's load, the mean over a step, gives one order more.
      const double order = method->name() == "paper"
                               ? 2
                               : dynamics::make_integrator(validation::named<dynamics::IntegratorKind>(
                                                               method->name(), "benchmark", "integrator"))
                                     ->order();
      const int steps = order < 2.0 ? 32 : (scene.kind == SceneKind::six_dof ? 8 : 4);
      const double coarse = error_at(*method, scene, steps), fine = error_at(*method, scene, 2 * steps);
      EXPECT_LT(coarse, 5e-3) << method->name() << " in " << scene.name;
      if (fine < 1e-9) continue;  // the references' own error
      const double found = std::log2(coarse / fine);
      EXPECT_NEAR(found, order, order < 5.0 ? 0.3 : 1.3) << method->name() << " in " << scene.name << " " << fine;
    }
  }
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
    if (method->name() != "exponential" || !knows_function(*method)) continue;
    for (const Scenario& scene : scenes) {
      for (const int steps : {1, 3, 16}) {
        EXPECT_LT(error_at(*method, scene, steps), 1e-7 * hand_amplitude(scene))
            << scene.name << " × " << scene.stiffness_factor << ", zeta " << scene.damping_ratio << ", " << steps;
      }
    }
  }
}

TEST(OurMethods, AHandByPosesAloneLeavesAnErrorThatStepsDoNotLowerAndFasterSamplesDo) {
  // Velocities by three-point differences: their error falls with the square of the sample interval.
  Scenario slow = six_dof_scene(100.0);
  Scenario fast = slow;
  fast.output_interval = 0.5 * slow.output_interval;
  for (const MethodPtr& method : our_methods()) {
    if (method->name() != "exponential" || knows_function(*method)) continue;
    const double floor = error_at(*method, slow, 16);
    EXPECT_NEAR(error_at(*method, slow, 32) / floor, 1.0, 0.01);
    EXPECT_GT(floor / error_at(*method, fast, 16), 3.0);
  }
}

}  // namespace
}  // namespace spring_workbench::benchmark
