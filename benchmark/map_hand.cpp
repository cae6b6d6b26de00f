#include "benchmark/map_hand.h"

#include <algorithm>
#include <cmath>
#include <random>

#include "benchmark/scenarios.h"
#include "spring_workbench/math/so3.h"

namespace spring_workbench::benchmark {
namespace {

constexpr double kMoving = 0.2;  // s
constexpr double kResting = 0.1;
constexpr int kLeastRests = 5;  // samples
constexpr int kRestsBefore = 3;
constexpr double kGap = 1.0;
constexpr double kLongestHeld = 0.5;  // s; the dropout rule of the settings
constexpr double kPi = 3.1415926535897932384626433832795;

/// The fork points forward and up.
RigidTransform home() {
  RigidTransform X = RigidTransform::Identity();
  X.linear() = math::exp_so3(Vector3d(0.0, 1.0, 0.0));
  return X;
}

RigidTransform lissajous(double t) {
  const HandState hand = hand_state(six_dof_scene(1.0), t);
  RigidTransform X = home();
  X.linear() = hand.R_WT * X.linear();
  X.translation() = hand.p_WT;
  return X;
}

RigidTransform moved(const Vector3d& shift, const Vector3d& turn) {
  RigidTransform X = home();
  X.linear() = math::exp_so3(turn) * X.linear();
  X.translation() += shift;
  return X;
}

bool same(const motion::PoseSample& a, const motion::PoseSample& b) { return a.X.matrix() == b.X.matrix(); }

}  // namespace

std::string name_of(MapHand hand) {
  switch (hand) {
    case MapHand::lissajous:
      return "lissajous";
    case MapHand::jump:
      return "jump";
    case MapHand::flip:
      return "flip";
    case MapHand::dropout:
      return "dropout";
    case MapHand::noise:
      break;
  }
  return "noise";
}

MapHandMotion map_hand_motion(MapHand hand, double interval, double step) {
  MapHandMotion motion;
  std::vector<motion::PoseSample>& samples = motion.samples;
  const auto count = [&](double seconds) {
    return std::max(kLeastRests, static_cast<int>(std::lround(seconds / interval)));
  };
  const auto next = [&] { return samples.empty() ? 0.0 : samples.back().t + interval; };
  const auto stay = [&](const RigidTransform& X, double seconds) {
    for (int i = 0, n = count(seconds); i < n; ++i) samples.push_back({next(), X});
  };
  std::mt19937 engine(7);
  const auto random = [&] { return 2.0 * (static_cast<double>(engine()) + 0.5) / 4294967296.0 - 1.0; };
  switch (hand) {
    case MapHand::lissajous:
      for (int i = 0, n = count(kMoving); i < n; ++i) samples.push_back({next(), lissajous(i * interval)});
      break;
    case MapHand::jump:
      for (int i = 0; i < kRestsBefore; ++i) samples.push_back({next(), home()});
      samples.push_back({next(), moved(Vector3d(0.6, 0.0, 0.8), Vector3d::Zero())});
      break;
    case MapHand::flip:
      for (int i = 0; i < kRestsBefore; ++i) samples.push_back({next(), home()});
      samples.push_back({next(), moved(Vector3d::Zero(), kPi * Vector3d(1.0, 1.0, 0.5).normalized())});
      break;
    case MapHand::dropout:
      for (int i = 0; i < kLeastRests; ++i) samples.push_back({next(), lissajous(i * interval)});
      samples.push_back({samples.back().t + kGap, moved(Vector3d(0.3, 0.0, 0.0), Vector3d(0.0, 0.0, 0.5))});
      break;
    case MapHand::noise:
      for (int i = 0, n = count(kMoving); i < n; ++i) {
        const Vector3d shift = 1e-3 * Vector3d(random(), random(), random());
        samples.push_back({next(), moved(shift, kPi / 180.0 * Vector3d(random(), random(), random()))});
      }
      break;
  }
  stay(RigidTransform(samples.back().X), kResting);
  for (std::size_t i = 0; i + 1 < samples.size(); ++i) {
    const bool gap = samples[i + 1].t - samples[i].t > kLongestHeld;
    // The hand's speed drops to zero as the gap begins, and its place changes where it ends.
    if (gap) motion.rests.emplace_back(samples[i].t + step, samples[i + 1].t - step);
    // Velocities come from three samples: a stretch rests where its neighbours do, too.
    const std::size_t last = std::min(i + 2, samples.size() - 1);
    if (gap || i == 0 || !same(samples[i - 1], samples[i]) || !same(samples[i], samples[i + 1]) ||
        !same(samples[i + 1], samples[last])) {
      continue;
    }
    if (!motion.rests.empty() && motion.rests.back().second == samples[i].t) {
      motion.rests.back().second = samples[i + 1].t;
    } else {
      motion.rests.emplace_back(samples[i].t, samples[i + 1].t);
    }
  }
  return motion;
}

}  // namespace spring_workbench::benchmark
