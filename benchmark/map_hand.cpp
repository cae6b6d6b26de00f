#include "benchmark/map_hand.h"

#include <algorithm>
#include <cmath>
#include <random>

#include "benchmark/scenarios.h"
#include "spring_workbench/math/so3.h"

namespace spring_workbench::benchmark {
namespace {

constexpr int kMinRests = 5;  // samples
constexpr int kRestsBefore = 3;
constexpr double kGap = 1.0;
constexpr double kLongestHeld = 0.5;  // s; `dropout_after` of the settings
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
    case MapHand::jump:
      return "jump";
    case MapHand::flip:
      return "flip";
    case MapHand::dropout:
      break;
  }
  return "dropout";
}

std::string name_of(MapTail tail) {
  switch (tail) {
    case MapTail::rest:
      return "rest";
    case MapTail::nanometre:
      return "1 nm";
    case MapTail::micrometre:
      return "1 um";
    case MapTail::tenth_of_a_millimetre:
      return "0.1 mm";
    case MapTail::millimetre:
      return "1 mm";
    case MapTail::lissajous:
      break;
  }
  return "lissajous";
}

namespace {

double tremor(MapTail tail) {  // [m]
  switch (tail) {
    case MapTail::nanometre:
      return 1e-9;
    case MapTail::micrometre:
      return 1e-6;
    case MapTail::tenth_of_a_millimetre:
      return 1e-4;
    case MapTail::millimetre:
      return 1e-3;
    case MapTail::rest:
    case MapTail::lissajous:
      break;
  }
  return 0.0;
}

}  // namespace

MapHandMotion map_hand_motion(MapHand hand, MapTail tail, double seconds, double interval, double step) {
  MapHandMotion motion;
  std::vector<motion::PoseSample>& samples = motion.samples;
  const auto next = [&] { return samples.empty() ? 0.0 : samples.back().t + interval; };
  for (int i = 0; i < kRestsBefore; ++i) samples.push_back({next(), home()});
  switch (hand) {
    case MapHand::jump:
      samples.push_back({next(), moved(Vector3d(0.6, 0.0, 0.8), Vector3d::Zero())});
      break;
    case MapHand::flip:
      samples.push_back({next(), moved(Vector3d::Zero(), kPi * Vector3d(1.0, 1.0, 0.5).normalized())});
      break;
    case MapHand::dropout:
      samples.push_back({next() + kGap, moved(Vector3d(0.3, 0.0, 0.0), Vector3d(0.0, 0.0, 0.5))});
      break;
  }
  std::mt19937 engine(7);
  const auto random = [&] { return 2.0 * (static_cast<double>(engine()) + 0.5) / 4294967296.0 - 1.0; };
  const std::size_t arrived = samples.size() - 1;
  const RigidTransform here = samples.back().X;
  const double size = tremor(tail);
  for (int i = 1, n = std::max(kMinRests, static_cast<int>(std::lround(seconds / interval))); i <= n; ++i) {
    RigidTransform X = here;
    if (tail == MapTail::lissajous) X = here * lissajous(0.0).inverse() * lissajous(i * interval);
    if (size > 0.0) X.translation() += size * Vector3d(random(), random(), random());
    samples.push_back({next(), X});
  }
  for (std::size_t i = 0; i + 1 < samples.size(); ++i) {
    const bool gap = samples[i + 1].t - samples[i].t > kLongestHeld;
    // The speed of the hand drops to zero at the start of the gap, and its position jumps at the end.
    if (gap) motion.watched.push_back({samples[i].t + step, samples[i + 1].t - step});
    // Velocities come from three samples, so an interval is at rest only if its neighbours are, too.
    const std::size_t last = std::min(i + 2, samples.size() - 1);
    if (gap || i == 0 || !same(samples[i - 1], samples[i]) || !same(samples[i], samples[i + 1]) ||
        !same(samples[i + 1], samples[last])) {
      continue;
    }
    if (!motion.watched.empty() && motion.watched.back().end == samples[i].t) {
      motion.watched.back().end = samples[i + 1].t;
    } else {
      motion.watched.push_back({samples[i].t, samples[i + 1].t});
    }
  }
  // From the second sample at the new pose, three neighbours have the same orientation.
  if (size > 0.0) motion.watched.push_back({samples[arrived + 1].t, samples.back().t, false});
  return motion;
}

}  // namespace spring_workbench::benchmark
