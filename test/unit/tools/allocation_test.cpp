// Several tools on one object take nothing from the heap in a step.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include "spring_workbench/math/so3.h"
#include "spring_workbench/tools/hold_maker.h"
#include "spring_workbench/tools/sharing.h"
#include "support/count_allocations.h"
#include "support/named.h"

namespace spring_workbench::tools::allocation_test {
namespace {

using test_support::allocations;

constexpr double length = 0.2, gravity = 9.81, interval = 0.02;

/// A hand above the object that draws a curve of some centimetres and turns with it.
motion::MotionSegment hand_at(double t, const Vector3d& from, double phase) {
  const auto sample = [&](double at) {
    const Vector3d p = from + 0.03 * Vector3d(std::sin(5.0 * at + phase), std::sin(3.0 * at), std::cos(4.0 * at));
    const Matrix3d turned = math::exp_so3(0.2 * std::sin(4.0 * at + phase) * Vector3d(0.6, 0.0, 0.8));
    return motion::PoseSample{at, make_transform(p, Quaterniond(turned) * Quaterniond(0.0, 1.0, 0.0, 0.0))};
  };
  const motion::PoseSample a = sample(t), b = sample(t + interval);
  const Vector3d v = (b.X.translation() - a.X.translation()) / interval, w = math::turn_between(a.X, b.X) / interval;
  return motion::MotionSegment(a, v, w, b, v, w);
}

/// One box on a fork and these tools, of which the last may be a probe.
struct Shared {
  Shared(const dynamics::DynamicsSettings& dynamics, const rod::ForkSettings& fork, const std::vector<Tool>& others)
      : maker(fork, dynamics, gravity) {
    body.name = "box";
    body.mass_properties = {1.0, Vector3d(0.0004, 0.0035, 0.0036).asDiagonal()};
    take(Tool::spring_fork);
    for (const Tool tool : others) tool == Tool::spring_probe ? touch(fork) : take(tool);
  }
  motion::MotionSegment hand(std::size_t tool, double t) const {
    const double side = tool % 2 == 0 ? -0.04 : 0.04, across = 0.01 * static_cast<double>(tool);
    return hand_at(t, {side, across, length}, 0.3 * static_cast<double>(tool));
  }
  void touch(const rod::ForkSettings& fork) {
    AxisHit front{0.9 * length, &body, &body.material};
    const RigidTransform X_WH = hand(tools.size(), 0.0).at(0.0).X;
    front.point_O = X_WO.inverse() * (X_WH * Vector3d(0.0, 0.0, front.distance));
    front.normal_O = -(X_WO.linear().transpose() * X_WH.linear().col(2));
    probe = std::make_unique<Probe>(length, fork, front, 0.0);
    tools.push_back({nullptr, probe.get()});
  }
  void take(Tool tool) {
    const RigidTransform X_WS = hand(tools.size(), 0.0).at(0.0).X;
    const RigidTransform X_WE = X_WS * Eigen::Translation3d(0.0, 0.0, length);
    holds.push_back(maker.make({tool, 0, X_WS, X_WO.inverse() * X_WE, length, length}, {0, body, X_WO}, 0.0));
    tools.push_back({holds.back().get(), nullptr});
  }
  /// Returns what a step took from the heap, without what was made for it.
  long step(double t) {
    for (std::size_t i = 0; i < holds.size(); ++i) holds[i]->set_hand(hand(i, t), t);
    if (probe) probe->set_hand(hand(holds.size(), t));
    Sharing sharing(tools, [] { return nullptr; });
    const long before = allocations;
    EXPECT_TRUE(sharing.body()->advance(interval, Wrench()));
    sharing.body()->accept();
    const motion::MotionState object = sharing.body()->object();
    sharing.end_step(object, t + interval);
    farthest = std::max(farthest, (object.X.translation() - X_WO.translation()).norm());
    return allocations - before;
  }

  scene::Body body;
  RigidTransform X_WO = RigidTransform::Identity();
  HoldMaker maker;
  std::vector<std::unique_ptr<ToolHold>> holds;
  std::unique_ptr<Probe> probe;
  std::vector<ToolOnObject> tools;
  double farthest = 0.0;  ///< that the box has been from where it was [m]
};

class SeveralTools : public testing::TestWithParam<std::string> {};

TEST_P(SeveralTools, AllocateNothingInAStep) {
  if (!COUNTS_ALLOCATIONS) GTEST_SKIP() << "a sanitizer has its own heap";
  constexpr Tool fork_tool = Tool::spring_fork, spring = Tool::spring, probe = Tool::spring_probe;
  const std::vector<std::vector<Tool>> several = {{fork_tool}, {spring}, {probe}, {fork_tool, spring, probe}};
  for (const std::vector<Tool>& others : several) {
    for (const std::string& shape : test_support::shape_names()) {
      for (const double tolerance : {0.0, 1e-3}) {
        dynamics::DynamicsSettings dynamics;
        dynamics.integrator = test_support::integrator_named(GetParam());
        dynamics.tolerance = tolerance;
        rod::ForkSettings fork;
        fork.shape = test_support::shape_named(shape);
        Shared shared(dynamics, fork, others);
        long counted = 0;
        for (int i = 0; i < 8; ++i) {
          const long of_step = shared.step(i * interval);
          if (i > 0) counted += of_step;
        }
        EXPECT_EQ(counted, 0) << shape << " and " << others.size() << " others, tolerance " << tolerance;
        EXPECT_GT(shared.farthest, 1e-3);
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Integrators, SeveralTools, testing::ValuesIn(test_support::integrator_names()),
                         [](const auto& instance) { return instance.param; });

}  // namespace
}  // namespace spring_workbench::tools::allocation_test
