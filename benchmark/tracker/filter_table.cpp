#include "filter_table.h"

#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include "motions.h"
#include "spring_workbench/hand_input/pose_filter.h"
#include "spring_workbench/hand_input/sample_gate.h"
#include "spring_workbench/motion/pose_track.h"

namespace spring_workbench {
namespace {

constexpr double kDropout = 0.5;  // [s]

std::vector<motion::PoseSample> samples_of(const std::string& path) {
  hand_input::SampleGate gate(hand_input::InputSettings(), kDropout);
  const bool synthetic = path.size() > 5 && path.substr(path.size() - 5) == ".yaml";
  std::mt19937 random(1);
  std::normal_distribution<double> noise(0.0, 5e-4);  // [m] along each axis
  std::vector<motion::PoseSample> samples;
  for (const motion::StylusSample& sample : read_samples(path)) {
    motion::PoseSample noisy = sample;
    if (synthetic) noisy.X.translation() += Vector3d(noise(random), noise(random), noise(random));
    const hand_input::RawSample raw{noisy.t, noisy.X.translation(), Quaterniond(noisy.X.linear())};
    if (hand_input::usable(gate.offer(raw))) samples.push_back(noisy);
  }
  return samples;
}

/// RMS distance of `given` from the track `later` [s] after each sample (default: at the sample); excludes samples near
/// ends and gaps.
double distance(const std::vector<motion::PoseSample>& given, motion::PoseTrack& track, double later = 0.0) {
  double sum = 0.0;
  int count = 0;
  for (const motion::PoseSample& sample : given) {
    const double t = sample.t + later;
    if (t < track.begin() || t > track.end() - 1e-6) continue;
    sum += (track.segment(t).at(t).X.translation() - sample.X.translation()).squaredNorm();
    ++count;
  }
  return std::sqrt(sum / count);
}

double lag_of(const std::vector<motion::PoseSample>& given, motion::PoseTrack& track) {
  double best = std::numeric_limits<double>::infinity(), lag = 0.0;
  for (double d = -0.08; d <= 0.16; d += 0.002) {
    const double off = distance(given, track, -d);
    if (off < best) best = off, lag = d;
  }
  return lag;
}

double jitter_of(const std::vector<motion::PoseSample>& given) {
  double sum = 0.0;
  for (std::size_t i = 1; i + 1 < given.size(); ++i) {
    sum +=
        (given[i - 1].X.translation() - 2.0 * given[i].X.translation() + given[i + 1].X.translation()).squaredNorm() /
        6.0;
  }
  return std::sqrt(sum / static_cast<double>(given.size() - 2));
}

void report(const std::string& path, std::ostream& out) {
  const std::vector<motion::PoseSample> measured = samples_of(path);
  motion::PoseTrack track(kDropout);
  for (const motion::PoseSample& sample : measured) track.push(sample);
  const std::string name = file_name(path);
  for (const double min_cutoff : {0.0, 0.5, 1.0, 2.0, 5.0}) {
    for (const double beta : min_cutoff > 0.0 ? std::vector<double>{5.0, 20.0} : std::vector<double>{0.0}) {
      hand_input::InputSettings settings;
      settings.min_cutoff = min_cutoff;
      settings.beta = beta;
      hand_input::PoseFilter filter(settings);
      std::vector<motion::PoseSample> given;
      for (const motion::PoseSample& sample : measured) given.push_back(filter.filter(sample));
      out << name << ',' << min_cutoff << ',' << beta << ',' << 1e3 * distance(given, track) << ','
          << 1e3 * lag_of(given, track) << ',' << 1e3 * jitter_of(given) << std::endl;
    }
  }
}

}  // namespace

void write_filter_table(const std::vector<std::string>& motions, std::ostream& out) {
  out << "motion,min_cutoff [Hz],beta [Hz/(m/s)],error [mm],lag [ms],jitter [mm]\n";
  for (const std::string& path : motions) report(path, out);
}

}  // namespace spring_workbench
