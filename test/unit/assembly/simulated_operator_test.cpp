#include "spring_workbench/assembly/simulated_operator.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "spring_workbench/assembly/trial.h"
#include "spring_workbench/math/so3.h"
#include "spring_workbench/validation/input_error.h"
#include "support/paths.h"
#include "support/random_poses.h"

namespace spring_workbench::assembly::simulated_operator_test {
namespace {

const std::string mini_world = test_support::checkout("scenes/mini_world.urdf");

simulation::SimulationSettings assembly_settings(tools::Calibration calibration = tools::Calibration::world) {
  simulation::SimulationSettings settings;
  settings.grasp.calibrate = calibration;
  settings.grasp.release = tools::Release::dropped;
  return settings;
}

OperatorSettings still_hand() {
  OperatorSettings settings;
  settings.position_noise = settings.angle_noise = settings.aim_scatter = 0.0;
  return settings;
}

/// A static world with every object at its start pose.
OperatorView view_of(const scene::Scene& scene) {
  OperatorView view;
  for (const scene::Body& body : scene.bodies) {
    if (!body.movable) continue;
    bodies::BodyState state;
    state.name = body.name;
    state.X_WO = body.X_WO;
    view.objects.push_back(state);
  }
  for (std::size_t hand = 0; hand < scene.X_WH_start.size(); ++hand) {
    view.tools.emplace_back();
    view.tools.back().X_HE.translation().z() = 0.2;
  }
  return view;
}

bool same(const RigidTransform& a, const RigidTransform& b) { return a.matrix() == b.matrix(); }

TEST(SimulatedOperator, AssemblesTheMiniWorldWithEveryFork) {
  const scene::Scene scene = scene::load_scene(mini_world);
  for (const rod::ForkDofs& dofs :
       {rod::ForkDofs{true, true, true}, rod::ForkDofs{true, true, false}, rod::ForkDofs{false, true, false}}) {
    for (unsigned seed = 1; seed <= 2; ++seed) {
      simulation::SimulationSettings settings =
          assembly_settings(seed == 1 ? tools::Calibration::world : tools::Calibration::object);
      settings.fork.dofs = dofs;
      OperatorSettings hand;
      hand.seed = seed;
      const Trial trial = run_trial(scene, settings, hand);
      EXPECT_EQ(trial.score.placed, static_cast<int>(scene.targets.size())) << dofs.stretch << dofs.torsion << seed;
      EXPECT_EQ(trial.score.drops, 0);
    }
  }
}

/// An impact of the carried object may cause some kilonewtons; a stop that created energy would cause far more.
TEST(SimulatedOperator, PressesNoHarderThanABlowOfItsHand) {
  const scene::Scene scene = scene::load_scene(mini_world);
  for (const unsigned seed : {1u, 3u}) {
    simulation::SimulationSettings settings = assembly_settings();
    settings.tool = tools::Tool::spring;
    OperatorSettings hand;
    hand.seed = seed;
    EXPECT_LT(run_trial(scene, settings, hand).score.largest_force, 1e5) << seed;
  }
}

TEST(SimulatedOperator, SameSeedSameBits) {
  const scene::Scene scene = scene::load_scene(mini_world);
  OperatorSettings hand;
  const Trial a = run_trial(scene, assembly_settings(), hand, 20.0);
  const Trial b = run_trial(scene, assembly_settings(), hand, 20.0);
  hand.seed = 2;
  const Trial c = run_trial(scene, assembly_settings(), hand, 20.0);
  ASSERT_EQ(a.motion.size(), b.motion.size());
  for (std::size_t i = 0; i < a.motion.size(); ++i) EXPECT_TRUE(same(a.motion[i].X, b.motion[i].X)) << i;
  EXPECT_EQ(score_csv(a.score), score_csv(b.score));
  EXPECT_NE(score_csv(a.score), score_csv(c.score));
}

TEST(SimulatedOperator, ActsOnWhatItPerceivedOneReactionTimeAgo) {
  const scene::Scene scene = scene::load_scene(mini_world);
  for (const double reaction : {0.0, 0.1, 0.3}) {
    OperatorSettings settings = still_hand();
    settings.reaction = reaction;
    // The first object in the list disappears at `moved`, while the hand is moving towards it.
    constexpr int moved = 60;
    int looks = 0;
    const OperatorView view = view_of(scene);
    OperatorView later = view;
    for (bodies::BodyState& o : later.objects) o.X_WO.translation().x() += 0.05;
    SimulatedOperator still(scene, settings, [&] { return view; });
    SimulatedOperator moving(scene, settings, [&] { return ++looks > moved ? later : view; });
    int first_difference = -1;
    for (int k = 0; k < 400 && first_difference < 0; ++k) {
      const auto a = still.next(), b = moving.next();
      ASSERT_TRUE(a && b);
      if (!same(a->X, b->X)) first_difference = k;
    }
    EXPECT_GE(first_difference, moved + static_cast<int>(reaction * settings.rate)) << reaction;
  }
}

/// Without tremor and reaction time, a reach takes 0.1 s plus 0.2 s per doubling of (distance + 1 cm) relative to 1 cm.
TEST(SimulatedOperator, ReachesFollowFittsLaw) {
  const scene::Scene scene = scene::load_scene(mini_world);
  OperatorSettings settings = still_hand();
  settings.reaction = 0.0;
  settings.rate = 1000.0;
  SimulatedOperator hand(scene, settings, [&] { return view_of(scene); });
  std::vector<RigidTransform> motion;
  for (int k = 0; k < 1500; ++k) motion.push_back(hand.next()->X);
  const Vector3d start = motion.front().translation();
  std::size_t end = 1;  // first rest: the speed of a reach is zero only at its end
  const auto speed = [&](std::size_t k) { return (motion[k + 1].translation() - motion[k].translation()).norm(); };
  while (end < 20 || speed(end) > speed(end - 1) || speed(end) > speed(end + 1)) ++end;
  const double way = (motion[end].translation() - start).norm();
  EXPECT_NEAR(1e-3 * static_cast<double>(end), 0.1 + 0.2 * std::log2(1.0 + way / 0.01), 3e-3);
}

TEST(SimulatedOperator, NoiseHasTheSetSize) {
  const scene::Scene scene = scene::load_scene(mini_world);
  OperatorSettings noisy = still_hand();
  noisy.position_noise = 1e-3;
  noisy.angle_noise = 2e-3;
  const OperatorView view = view_of(scene);
  SimulatedOperator still(scene, still_hand(), [&] { return view; });
  SimulatedOperator shaking(scene, noisy, [&] { return view; });
  double p2 = 0.0, a2 = 0.0;
  constexpr int count = 1000;
  for (int k = 0; k < count; ++k) {
    const auto a = still.next(), b = shaking.next();
    ASSERT_TRUE(a && b);
    p2 += (a->X.translation() - b->X.translation()).squaredNorm() / (3 * count);
    a2 += math::log_so3(a->X.linear().transpose() * b->X.linear()).squaredNorm() / (3 * count);
  }
  // The relative standard deviation of the estimates is 1 / sqrt(2 · 3000) = 1.3 %.
  EXPECT_NEAR(std::sqrt(p2), 1e-3, 0.06e-3);
  EXPECT_NEAR(std::sqrt(a2), 2e-3, 0.12e-3);
}

/// In a world in which the tip never enters an object, the hand moves down over each object four times.
TEST(SimulatedOperator, GivesUpAnObjectAfterFourAttempts) {
  const scene::Scene scene = scene::load_scene(mini_world);
  SimulatedOperator hand(scene, still_hand(), [&] { return view_of(scene); });
  std::vector<double> heights;
  while (const auto sample = hand.next()) heights.push_back(sample->X.translation().z());
  const auto [lowest, highest] = std::minmax_element(heights.begin(), heights.end());
  const double middle = 0.5 * (*lowest + *highest);
  std::size_t descents = 0;
  for (std::size_t k = 1; k < heights.size(); ++k) descents += heights[k - 1] > middle && heights[k] <= middle;
  EXPECT_EQ(descents, 4 * scene.targets.size());
}

TEST(SimulatedOperator, IgnoresObjectsInPlace) {
  scene::Scene scene = scene::load_scene(mini_world);
  for (scene::Body& body : scene.bodies) {
    if (body.movable) body.X_WO = scene.targets.at(body.name).X_WL * body.X_OL.inverse();
  }
  const Trial trial = run_trial(scene, assembly_settings(), OperatorSettings());
  EXPECT_TRUE(trial.score.complete());
  EXPECT_EQ(trial.score.grasps, 0);
  EXPECT_LT(trial.motion.back().t, 2.0);
}

const std::string two_handed = test_support::checkout("scenes/two_handed.urdf");

/// Hands that reach together move in parallel, whatever their own distances, so that a long object is not strained.
TEST(OperatorHands, ThatReachTogetherKeepTheirDistance) {
  test_support::Random random(5);
  for (int i = 0; i < 50; ++i) {
    const std::vector<RigidTransform> start = {random.pose(1.0), random.pose(1.0)};
    OperatorHands hands(start, still_hand());
    const Vector3d way = random.vector(0.5);
    const auto moved = [&](std::size_t hand) { return RigidTransform(Eigen::Translation3d(way) * start[hand]); };
    const double end = hands.reach({0, 1}, moved, 1.0);
    EXPECT_NEAR(end, 1.1 + 0.2 * std::log2(1.0 + way.norm() / 0.01), 1e-9);
    const Vector3d apart = start[1].translation() - start[0].translation();
    for (double t = 0.9; t < end + 0.1; t += 0.02) {
      const Vector3d a = hands.sample(0, t).X.translation(), b = hands.sample(1, t).X.translation();
      EXPECT_LT((b - a - apart).norm(), 1e-12) << t;
    }
    EXPECT_LT((hands.X_WH()[1].translation() - moved(1).translation()).norm(), 1e-12);
  }
}

/// An interrupted reach continues from the current pose.
TEST(OperatorHands, DoNotLeapWhenAReachIsBroken) {
  const RigidTransform start = RigidTransform::Identity();
  OperatorHands hands({start}, still_hand());
  const auto to = [](double x) {
    return [x](std::size_t) { return RigidTransform(Eigen::Translation3d(x, 0.0, 0.0)); };
  };
  const double end = hands.reach({0}, to(0.4), 0.0);
  const double before = hands.sample(0, 0.5 * end).X.translation().x();
  EXPECT_NEAR(before, 0.2, 1e-9);
  hands.reach({0}, to(-0.1), 0.5 * end);
  EXPECT_NEAR(hands.sample(0, 0.5 * end + 1e-3).X.translation().x(), before, 1e-4);
}

/// The bar needs both hands, and the box goes from one to the other: four grasps, nothing falls.
TEST(SimulatedOperator, CarriesABarWithTwoHandsAndHandsABoxOver) {
  scene::Scene scene = scene::load_scene(two_handed);
  for (const tools::Tool tool : {tools::Tool::spring_fork, tools::Tool::direct}) {
    simulation::SimulationSettings settings = assembly_settings();
    settings.tool = tool;
    const Trial trial = run_trial(scene, settings, OperatorSettings());
    EXPECT_TRUE(trial.score.complete());
    EXPECT_EQ(trial.score.grasps, 4);
    EXPECT_EQ(trial.score.drops, 0);
  }
}

/// The object is held by the near hand alone, both hands, the far one alone; and in reverse.
TEST(SimulatedOperator, HandsOverFromTheNearHandToTheFarOne) {
  for (const double side : {1.0, -1.0}) {
    scene::Scene scene = scene::load_scene(two_handed);
    scene.targets.erase("bar");
    scene::Body& box = scene.bodies[*scene::find_body(scene, "box")];
    box.X_WO.translation().x() *= side;
    scene.targets["box"].X_WL.translation().x() *= side;
    const Trial trial = run_trial(scene, assembly_settings(), OperatorSettings());
    EXPECT_TRUE(trial.score.complete());
    std::vector<std::string> order;
    for (std::size_t k = 0; k + 1 < trial.motion.size(); k += 2) {
      ASSERT_EQ(trial.motion[k].t, trial.motion[k + 1].t);
      const std::string pressed = std::to_string(trial.motion[k].button) + std::to_string(trial.motion[k + 1].button);
      if (order.empty() || order.back() != pressed) order.push_back(pressed);
    }
    const std::string near = side > 0.0 ? "10" : "01", far = side > 0.0 ? "01" : "10";
    EXPECT_EQ(order, (std::vector<std::string>{"00", near, "11", far, "00"}));
  }
}

TEST(SimulatedOperator, BadSettingsAreRefused) {
  const scene::Scene scene = scene::load_scene(mini_world);
  const auto refused = [&](const std::function<void(OperatorSettings&)>& spoil) {
    OperatorSettings settings;
    spoil(settings);
    EXPECT_THROW(SimulatedOperator(scene, settings, [&] { return view_of(scene); }), validation::InputError);
  };
  refused([](OperatorSettings& s) { s.rate = 0.0; });
  refused([](OperatorSettings& s) { s.reaction = -0.1; });
  refused([](OperatorSettings& s) { s.position_noise = std::numeric_limits<double>::quiet_NaN(); });
  refused([](OperatorSettings& s) { s.angle_noise = 2.0; });
  refused([](OperatorSettings& s) { s.aim_scatter = 1.0; });
}

}  // namespace
}  // namespace spring_workbench::assembly::simulated_operator_test
