#pragma once

#include <random>

#include "spring_workbench/math/so3.h"
#include "spring_workbench/motion/pose_track.h"

namespace spring_workbench::test_support {

/// A hand on sines of 1 to 2 Hz as a tracker at 50 Hz would see it, with this noise [m; 5 rad per m]: its acceleration
/// jumps at each sample.
inline motion::PoseTrack tracked_hand(double duration, double noise, std::mt19937& random) {
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  std::normal_distribution<double> normal;
  const auto vector = [](auto& of) {
    const double x = of(), y = of(), z = of();
    return Vector3d(x, y, z);
  };
  const auto any = [&] { return uniform(random); };
  const auto jitter = [&] { return noise * normal(random); };
  const Vector3d rate = 2.0 * M_PI * (Vector3d::Constant(1.5) + 0.5 * vector(any)), phase = M_PI * vector(any);
  const Vector3d width = 0.1 * vector(any), turn = 0.5 * vector(any);
  motion::PoseTrack track;
  for (double t = 0.0; t < duration + 0.01; t += 0.02) {
    const Vector3d s = (rate * t + phase).array().sin();
    const Vector3d place = width.cwiseProduct(s) + vector(jitter), angle = turn.cwiseProduct(s) + 5.0 * vector(jitter);
    track.push({t, make_transform(place, Quaterniond(math::exp_so3(angle)))});
  }
  return track;
}

}  // namespace spring_workbench::test_support
