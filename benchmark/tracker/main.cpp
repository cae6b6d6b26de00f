#include <cmath>
#include <iostream>
#include <limits>
#include <random>
#include <vector>

#include "spring_workbench/config/input_error.h"
#include "spring_workbench/motion/pose_track.h"
#include "spring_workbench/tracker/stylus_source.h"
#include "spring_workbench/tracker/truth_layer.h"

/// What the jitter filter and the prediction do to motions, as CSV on standard output: `tracker_report FILE…`.
/// error: RMS distance of the pose given for a sample from where the hand was `prediction` later. lag: by how much the
/// path given comes later than the path measured, where the two fit best; negative where it is foretold. jitter: the part of
/// the path given that three neighbouring samples on a line would not have, RMS(p₋ − 2 p + p₊)/√6, which for white noise is
/// its standard deviation along all axes together.
namespace spring_workbench {
namespace {

constexpr double kDropout = 0.5;  // [s]

std::vector<PoseSample> samples_of(const std::string& path) {
  const auto source = open_motion(path);
  TruthLayer truth(TruthSettings(), kDropout);
  const bool synthetic = path.size() > 5 && path.substr(path.size() - 5) == ".yaml";
  std::mt19937 random(1);
  std::normal_distribution<double> noise(0.0, 5e-4);  // [m] along each axis
  std::vector<PoseSample> samples;
  while (const auto sample = source->next()) {
    PoseSample noisy = *sample;
    if (synthetic) noisy.X.translation() += Vector3d(noise(random), noise(random), noise(random));
    const TrueSample taken = truth.take(noisy);
    if (usable(taken.verdict)) samples.push_back(taken.sample);
  }
  return samples;
}

/// RMS distance of `given` from the track `later` [s] after each sample; samples near its ends and gaps are left out.
double distance(const std::vector<PoseSample>& given, PoseTrack& track, double later) {
  double sum = 0.0;
  int count = 0;
  for (const PoseSample& sample : given) {
    const double t = sample.t + later;
    if (t < track.begin() || t > track.end() - 1e-6) continue;
    sum += (track.segment(t).at(t).X.translation() - sample.X.translation()).squaredNorm();
    ++count;
  }
  return std::sqrt(sum / count);
}

double lag_of(const std::vector<PoseSample>& given, PoseTrack& track) {
  double best = std::numeric_limits<double>::infinity(), lag = 0.0;
  for (double d = -0.08; d <= 0.16; d += 0.002) {
    const double off = distance(given, track, -d);
    if (off < best) best = off, lag = d;
  }
  return lag;
}

double jitter_of(const std::vector<PoseSample>& given) {
  double sum = 0.0;
  for (std::size_t i = 1; i + 1 < given.size(); ++i) {
    sum += (given[i - 1].X.translation() - 2.0 * given[i].X.translation() + given[i + 1].X.translation()).squaredNorm() / 6.0;
  }
  return std::sqrt(sum / static_cast<double>(given.size() - 2));
}

void report(const std::string& path) {
  const std::vector<PoseSample> measured = samples_of(path);
  PoseTrack track(kDropout);
  for (const PoseSample& sample : measured) track.push(sample);
  const std::string name = path.substr(path.rfind('/') + 1);
  for (const double min_cutoff : {0.0, 0.5, 1.0, 2.0, 5.0}) {
    for (const double beta : min_cutoff > 0.0 ? std::vector<double>{5.0, 20.0} : std::vector<double>{0.0}) {
      for (const double prediction : {0.0, 0.01, 0.02, 0.04}) {
        TruthSettings settings;
        settings.min_cutoff = min_cutoff;
        settings.beta = beta;
        settings.prediction = prediction;
        PoseFilter filter(settings);
        std::vector<PoseSample> given;
        for (const PoseSample& sample : measured) given.push_back(filter.filter(sample));
        std::cout << name << ',' << min_cutoff << ',' << beta << ',' << 1e3 * prediction << ','
                  << 1e3 * distance(given, track, prediction) << ',' << 1e3 * lag_of(given, track) << ','
                  << 1e3 * jitter_of(given) << std::endl;
      }
    }
  }
}

}  // namespace
}  // namespace spring_workbench

int main(int argc, char** argv) {
  try {
    std::cout << "motion,min_cutoff [Hz],beta [Hz/(m/s)],prediction [ms],error [mm],lag [ms],jitter [mm]\n";
    for (int i = 1; i < argc; ++i) spring_workbench::report(argv[i]);
    return 0;
  } catch (const spring_workbench::InputError& e) {
    std::cerr << "tracker_report: " << e.what() << std::endl;
    return 2;
  }
}
