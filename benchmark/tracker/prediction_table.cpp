#include "prediction_table.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iomanip>
#include <map>

#include "motions.h"
#include "spring_workbench/live/look_ahead.h"
#include "spring_workbench/math/so3.h"
#include "spring_workbench/validation/names.h"

namespace spring_workbench {
namespace {

using scene::ContactMode;

constexpr double kFork = 0.2;                                            // [m] from the handle to the tip
constexpr std::array<double, 5> kAhead = {0.0, 0.01, 0.02, 0.03, 0.05};  // [s]
constexpr double kInTheAir = 0.03;  // [m] initial height of the box above the bench, if the motion goes as high

/// The scene of one box, with the box at the tip of a fork that points down.
scene::Scene held_at(const Vector3d& handle, scene::Scene scene, ContactMode contact) {
  scene::Body& box = *std::find_if(scene.bodies.begin(), scene.bodies.end(), [](const auto& b) { return b.movable; });
  box.X_WO = make_transform(handle - Vector3d(0.0, 0.0, kFork), Quaterniond::Identity());
  scene.contact = contact;
  return scene;
}

/// The motion from its first sample in the air, shifted such that the box touches the bench at the median height.
std::vector<motion::PoseSample> above_the_bench(const std::string& path) {
  std::vector<motion::PoseSample> samples;
  std::vector<double> heights;
  for (const motion::StylusSample& sample : read_samples(path)) {
    samples.push_back(sample);
    heights.push_back(sample.X.translation().z());
  }
  const auto middle = heights.begin() + static_cast<std::ptrdiff_t>(heights.size() / 2);
  std::nth_element(heights.begin(), middle, heights.end());
  const double touching = *middle;
  const double in_the_air = std::min(touching + kInTheAir, *std::max_element(heights.begin(), heights.end()));
  const auto first = std::find_if(samples.begin(), samples.end(), [&](const motion::PoseSample& sample) {
    return sample.X.translation().z() >= in_the_air;
  });
  samples.erase(samples.begin(), first);
  const Matrix3d down = Quaterniond(0.0, 1.0, 0.0, 0.0).toRotationMatrix();
  const Matrix3d turn = samples.front().X.linear().transpose() * down;
  for (motion::PoseSample& sample : samples) {
    sample.X.linear() = sample.X.linear() * turn;
    sample.X.translation().z() += kFork + 0.02 - touching;
  }
  return samples;
}

struct Errors {
  std::vector<double> positions, angles;  ///< [m], [rad]
};

double quantile(std::vector<double> values, double part) {
  const auto at =
      values.begin() + static_cast<std::ptrdiff_t>(std::ceil(part * static_cast<double>(values.size() - 1)));
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

double rms(const std::vector<double>& values) {
  double sum = 0.0;
  for (const double value : values) sum += value * value;
  return std::sqrt(sum / static_cast<double>(values.size()));
}

/// A hand that holds the box, the copies that are advanced ahead, and the displayed poses that are not committed yet.
class Run {
 public:
  Run(const std::vector<motion::PoseSample>& samples, const scene::Scene& scene, ContactMode contact)
      : samples_(samples), scene_(held_at(samples.front().X.translation(), scene, contact)), settings_(settings()) {
    for (std::size_t i = 0; i < kAhead.size(); ++i) ahead_.emplace_back(scene_, settings_);
  }

  std::array<Errors, kAhead.size()> errors() {
    double now = samples_.front().t;
    for (const motion::PoseSample& sample : samples_) {
      now = std::max(now, sample.t);
      const hand_input::GateResult result = filter_.push_stylus(
          {sample.t, sample.X.translation(), Quaterniond(sample.X.linear())}, RigidTransform::Identity(), {now, now});
      while (const std::optional<double> stop = filter_.next_target({now, now})) commit(*stop);
      if (!hand_input::usable(result)) continue;
      for (std::size_t i = 0; i < kAhead.size(); ++i) {
        const double t = simulation_.newest_sample_time() + kAhead[i];
        ahead_[i].show(simulation_, filter_, t);
        const bodies::BodyState& box = ahead_[i].shown().objects()[0];
        if (box.held) shown_.emplace(t, Shown{i, box.X_WO});
      }
    }
    return errors_;
  }

 private:
  static simulation::SimulationSettings settings() {
    simulation::SimulationSettings settings;
    settings.grasp.object = "box";
    return settings;
  }

  struct Shown {
    std::size_t ahead = 0;  ///< index into kAhead
    RigidTransform X_WO;
  };

  /// Commits up to `stop` and compares with the poses displayed for these times. A copy stops at those before `stop`.
  void commit(double stop) {
    shown_.erase(shown_.begin(), shown_.lower_bound(simulation_.time()));
    const auto at_stop = shown_.lower_bound(stop);
    if (shown_.begin() != at_stop) between_.copy_state_from(simulation_);
    for (auto shown = shown_.begin(); shown != at_stop; ++shown) {
      between_.advance_to(shown->first);
      compare(shown->second, between_);
    }
    filter_.advance_to(stop);
    const auto end = shown_.upper_bound(stop);
    for (auto shown = at_stop; shown != end; ++shown) compare(shown->second, simulation_);
    shown_.erase(shown_.begin(), end);
  }

  void compare(const Shown& shown, const simulation::Simulation& committed) {
    const RigidTransform& X_WO = committed.objects()[0].X_WO;
    errors_[shown.ahead].positions.push_back((X_WO.translation() - shown.X_WO.translation()).norm());
    errors_[shown.ahead].angles.push_back(math::turn_between(X_WO, shown.X_WO).norm());
  }

  const std::vector<motion::PoseSample>& samples_;
  scene::Scene scene_;
  simulation::SimulationSettings settings_;
  simulation::Simulation simulation_{scene_, settings_}, between_{scene_, settings_};
  hand_input::InputFilter filter_{simulation_, hand_input::InputSettings(), hand_input::InputFilter::Prediction::on};
  std::vector<live::LookAhead> ahead_;
  std::multimap<double, Shown> shown_;  ///< not committed yet, by time [s]
  std::array<Errors, kAhead.size()> errors_;
};

}  // namespace

void write_prediction_table(const std::string& scene_path, const std::vector<std::string>& motions, std::ostream& out) {
  const scene::Scene scene = scene::load_scene(scene_path);
  constexpr double mm = 1e3, degree = 180.0 / M_PI;
  out << std::setprecision(3)
      << "motion,contact,ahead [ms],samples,rms [mm],99 % [mm],largest [mm],rms [deg],99 % [deg]\n";
  for (const std::string& path : motions) {
    const std::vector<motion::PoseSample> samples = above_the_bench(path);
    for (const ContactMode contact : {ContactMode::none, ContactMode::stop, ContactMode::dynamic}) {
      const std::array<Errors, kAhead.size()> all = Run(samples, scene, contact).errors();
      for (std::size_t i = 0; i < kAhead.size(); ++i) {
        const auto& [p, a] = all[i];
        out << file_name(path) << ',' << validation::name_of(contact) << ',' << mm * kAhead[i] << ',' << p.size() << ','
            << mm * rms(p) << ',' << mm * quantile(p, 0.99) << ',' << mm * quantile(p, 1.0) << ',' << degree * rms(a)
            << ',' << degree * quantile(a, 0.99) << std::endl;
      }
    }
  }
}

}  // namespace spring_workbench
