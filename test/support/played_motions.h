#pragma once

#include <cmath>
#include <vector>

#include "spring_workbench/simulated_fastrak/fastrak_device.h"

namespace spring_workbench::test_support {

/// A hand that moves around a circle in 3 s and turns, in the half-space x > 0 of the transmitter, without repeating a
/// pose.
inline simulated_fastrak::PlayedMotion circling_hand(double x = 0.5) {
  std::vector<motion::StylusSample> samples;
  for (int i = 0; i <= 300; ++i) {
    const double angle = 2.0 * M_PI * i / 300.0;
    motion::StylusSample sample;
    sample.t = 0.01 * i;
    sample.X = make_transform({x + 0.1 * std::cos(angle), 0.1 * std::sin(angle), 0.2 + 0.03 * std::sin(2.0 * angle)},
                              Quaterniond(Eigen::AngleAxisd(0.7 * std::sin(angle), Vector3d(0.6, 0.0, 0.8))));
    sample.button = i % 100 >= 50;
    samples.push_back(sample);
  }
  return simulated_fastrak::PlayedMotion(samples);
}

/// The button is down in the second half of each second.
inline simulated_fastrak::PlayedMotion pressing_hand() {
  std::vector<motion::StylusSample> samples(3);
  for (int i = 0; i < 3; ++i) {
    samples[static_cast<std::size_t>(i)].t = 0.5 * i;
    samples[static_cast<std::size_t>(i)].X = make_transform({0.3, 0.0, 0.1}, Quaterniond::Identity());
    samples[static_cast<std::size_t>(i)].button = i == 1;
  }
  return simulated_fastrak::PlayedMotion(samples);
}

}  // namespace spring_workbench::test_support
